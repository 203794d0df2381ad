// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/shaking/MpmFreeField.hpp"
#include "core/base/sentence.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/shaking/free_fields.hpp"
#include "yade_api/registration.hpp"

namespace yade {

void MpmFreeField::requireAdmissible() const
{
	Exposed<MpmFreeField, MpmCondition>::requireAdmissible();
	surface->requireAdmissible();
	surface->requireOneSide("MpmFreeField.surface");
	if (motion) motion->requireAdmissible();
	if (motion && !times.empty())
		throw std::invalid_argument("MpmFreeField: a wave from beyond is given by motion, and a field that moves by times: give one of them.");
	const std::pair<const char*, const vector<Real>*> tables[]
	        = { { "velocities", &velocities }, { "displacements", &displacements }, { "forces", &forces } };
	for (const auto& [name, table] : tables)
		if (table->size() != 2 * times.size() * surface->vertices.size())
			throw std::invalid_argument(gimpm::sentence(
			        "MpmFreeField.", name, " has ", table->size(), " numbers, but there are ", times.size(), " times and ",
			        surface->vertices.size(), " vertices: expected x and y of each vertex at each time."));
}

std::shared_ptr<Condition<2>> MpmFreeField::make(InPlane, const Group& group, const Analysis& analysis) const
{
	return std::make_shared<FreeFields>(group, analysis);
}

std::shared_ptr<Condition<3>> MpmFreeField::make(InSpace, const Group& group, const Analysis&) const
{
	throw std::invalid_argument(group.front().name() + ", an MpmFreeField, is of plane strain: on a grid with dim=3 take MpmAbsorbingBoundary.");
}

void MpmFreeField::requireFitting(const Analysis& analysis, const string& name) const
{
	string what;
	if (!analysis.isDynamic())
		what = "MpmImplicitEngine, whose steps are static: constrain the edges by MpmBoundary there, and take MpmDynamicEngine after it";
	else if (analysis.isExplicit())
		what = "scheme='explicit', as its dashpots join several nodes: take 'newmark' or 'generalised-alpha'";
	else if (analysis.grid->axisymmetric)
		what = "an axis of symmetry: take MpmAbsorbingBoundary";
	if (!what.empty()) throw std::invalid_argument(name + ", an MpmFreeField, cannot go with " + what + ".");
}

void MpmFreeField::tell(Rows& rows, const Analysis& analysis, const Listed& listed) const
{
	rows.setVector("load" + std::to_string(listed.number), reaction, analysis.grid->dim);
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmFreeField)
static const yade::PluginClasses<yade::MpmFreeField> registeredMpmFreeField(__FILE__);
