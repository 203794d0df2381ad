// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/boundary/MpmBoundary.hpp"
#include "core/base/sentence.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/bodies/layers.hpp"
#include "engine/conditions/boundary/boundaries.hpp"
#include "engine/conditions/surface/drawing.hpp"
#include "engine/grid/box.hpp"
#include "yade_api/registration.hpp"

namespace yade {

bool MpmBoundary::namesDirections(const string& letters)
{
	if (letters == "n") return true;
	for (size_t i = 0; i < letters.size(); ++i)
		if (string("xyz").find(letters[i]) == string::npos || letters.find(letters[i], i + 1) != string::npos) return false;
	return !letters.empty();
}

std::optional<std::pair<Vector3r, Vector3r>> MpmBoundary::extent() const
{
	if (!surface) return { { min, max } };
	Vector3r lower = surface->vertices.front(), upper = lower;
	for (const Vector3r& x : surface->vertices)
		lower = lower.cwiseMin(x), upper = upper.cwiseMax(x);
	return { { lower, upper } };
}

// Along one axis; empty if nothing does.
string MpmBoundary::whatContradicts(int axis) const
{
	const char         direction = "xyz"[axis];
	std::ostringstream text;
	if (surface && (std::isfinite(min[axis]) || std::isfinite(max[axis])))
		text << "MpmBoundary has a surface and a box, from min = " << textOf(min) << " to max = " << textOf(max)
		     << ": give one of them, or two boundaries.";
	else if (surface && displacement[axis] != 0)
		text << "MpmBoundary.displacement = " << displacement[axis] << " along " << direction
		     << " is that of the nodes in a box: a surface moves by its velocity.";
	else if (!surface && velocity[axis] != 0)
		text << "MpmBoundary.velocity = " << velocity[axis] << " along " << direction
		     << " is that of a surface: the nodes in a box move by their displacement.";
	else if (surface && motion)
		text << "MpmBoundary.motion is that of the nodes in a box: a surface moves by its velocity.";
	else if (displacement[axis] != 0 && motion)
		text << "MpmBoundary.displacement = " << displacement[axis] << " along " << direction << ", and motion: give one of them.";
	else if (displacement[axis] != 0 && !fixes(axis))
		text << "MpmBoundary.displacement = " << displacement[axis] << " along " << direction << ", a direction that fix = '" << fix
		     << "' leaves free.";
	else if (velocity[axis] != 0 && !fixes(axis) && !fixesNormal())
		text << "MpmBoundary.velocity = " << velocity[axis] << " along " << direction << ", a direction that fix = '" << fix << "' leaves free.";
	return text.str();
}

void MpmBoundary::requireAdmissible() const
{
	Exposed<MpmBoundary, MpmCondition>::requireAdmissible();
	if (surface) surface->requireAdmissible();
	else if (fixesNormal())
		throw std::invalid_argument("MpmBoundary.fix = 'n' is the normal of a surface, which is not given: name directions of the box, as in fix='x'.");
	if (!surface && penalty != MpmBoundary().penalty)
		throw std::invalid_argument(
		        "MpmBoundary.penalty = " + textOf(penalty) + " is that of a surface, which is not given: the nodes in a box do not give way.");
	if (!curve.empty() && displacement.isZero(0))
		throw std::invalid_argument("MpmBoundary.curve multiplies displacement, which is zero: give one, or leave the curve out.");
	requireCorners("MpmBoundary", min, max);
	for (int axis = 0; axis < 3; ++axis)
		if (const string text = whatContradicts(axis); !text.empty()) throw std::invalid_argument(text);
}

std::shared_ptr<Condition<2>> MpmBoundary::make(InPlane, const Group& group, const Analysis& analysis) const
{
	return std::make_shared<Boundaries<2>>(group, analysis);
}

std::shared_ptr<Condition<3>> MpmBoundary::make(InSpace, const Group& group, const Analysis& analysis) const
{
	return std::make_shared<Boundaries<3>>(group, analysis);
}

Real MpmBoundary::end(const Analysis& analysis) const { return analysis.curveOfLoad(curve).end(); }

void MpmBoundary::requireFitting(const Analysis& analysis, const string& name) const
{
	requireOwnNodes(analysis, body, name);
	if (motion && !analysis.isDynamic())
		throw std::invalid_argument(
		        name + ".motion is a history in time, which MpmImplicitEngine knows nothing of: take MpmDynamicEngine, or give displacement.");
}

bool MpmBoundary::mayHold(int axis, Real place, Real near) const
{
	if (surface) return true;
	return fixes(axis) && min[axis] <= place + near && max[axis] >= place - near && (std::isfinite(min[axis]) || std::isfinite(max[axis]));
}

string MpmBoundary::idleness(const string& name, bool reaches) const
{
	if (reaches) return "";
	const auto [lower, upper] = *extent();
	return gimpm::sentence(
	        " ", name, ", from (", lower.transpose(), ") to (", upper.transpose(), "), holds ", surface ? "no material" : "no node of any material",
	        body.empty() ? "" : " of body '" + body + "'", ".");
}

void MpmBoundary::tell(Rows& rows, const Analysis& analysis, const Listed& listed) const
{
	const bool isKnown = analysis.reactions.size() == listed.count;
	for (int axis = 0; axis < analysis.grid->dim; ++axis)
		if (fixes(axis) || fixesNormal())
			rows.set(
			        "reaction" + std::to_string(listed.number) + "_" + "xyz"[axis],
			        isKnown ? analysis.reactions[listed.number][axis] : std::numeric_limits<Real>::quiet_NaN());
}

void MpmBoundary::draw(Picture& picture, const Analysis&, const Listed& listed) const
{
	if (!surface) return;
	drawSurface(picture, *surface, "boundary", listed.number, [&](size_t i) { // empty before the first step
		return i < tractions.size() ? tractions[i] : Vector3r(Vector3r::Zero());
	});
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmBoundary)
static const yade::PluginClasses<yade::MpmBoundary> registeredMpmBoundary(__FILE__);
