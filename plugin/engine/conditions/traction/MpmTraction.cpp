// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/traction/MpmTraction.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/bodies/layers.hpp"
#include "engine/conditions/surface/drawing.hpp"
#include "engine/conditions/traction/surface_loads.hpp"
#include "yade_api/registration.hpp"

namespace yade {

void MpmTraction::requireAdmissible() const
{
	Exposed<MpmTraction, MpmCondition>::requireAdmissible();
	surface->requireAdmissible();
}

std::shared_ptr<Condition<2>> MpmTraction::make(InPlane, const Group& group, const Analysis&) const { return std::make_shared<SurfaceLoads<2>>(group); }
std::shared_ptr<Condition<3>> MpmTraction::make(InSpace, const Group& group, const Analysis&) const { return std::make_shared<SurfaceLoads<3>>(group); }

Real MpmTraction::end(const Analysis& analysis) const { return analysis.curveOfLoad(curve).end(); }

void MpmTraction::requireFitting(const Analysis& analysis, const string& name) const { requireOwnNodes(analysis, body, name); }

vector<Vector3r> MpmTraction::places() const
{
	vector<Vector3r> found = surface->vertices;
	for (const auto& piece : surface->pieces) {
		Vector3r sum = Vector3r::Zero();
		for (const int v : piece)
			sum += surface->vertices[v];
		found.push_back(sum / Real(piece.size()));
	}
	return found;
}

void MpmTraction::tell(Rows& rows, const Analysis& analysis, const Listed& listed) const
{
	rows.setVector("load" + std::to_string(listed.number), resultant, analysis.grid->dim);
}

void MpmTraction::draw(Picture& picture, const Analysis& analysis, const Listed& listed) const
{
	const Real factor = analysis.curveOfLoad(curve).valueAt(analysis.loadTime);
	drawSurface(picture, *surface, "load", listed.number, [&](size_t i) {
		const Vector3r now   = surface->normal(surface->pieces[i], surface->vertices);
		const Vector3r first = surface->initialVertices.empty() ? now : surface->normal(surface->pieces[i], surface->initialVertices);
		return Vector3r(factor * (first.norm() / now.norm() * traction - pressure * now.normalized()));
	});
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmTraction)
static const yade::PluginClasses<yade::MpmTraction> registeredMpmTraction(__FILE__);
