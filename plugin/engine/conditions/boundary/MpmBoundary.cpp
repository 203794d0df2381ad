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
	        " ", name, ", from (", lower.transpose(), ") to (", upper.transpose(), "), constrains ", surface ? "no material" : "no node of any material",
	        body.empty() ? "" : " of body '" + body + "'", ".");
}

namespace {
	// The lowest coordinate of soil along an axis, or along its opposite, that a box has beside it, in cells from
	// the origin of the grid; infinite without soil.
	Real edgeOfSoil(const MpmBoundary& box, const vector<MaterialPoint>& points, const MpmGrid& grid, int axis, int sign)
	{
		Real edge = std::numeric_limits<Real>::infinity();
		for (const MaterialPoint& point : points) {
			bool isBeside = true;
			for (int a = 0; a < grid.dim; ++a)
				isBeside = isBeside && (a == axis || (box.min[a] <= point.state->refPos[a] && point.state->refPos[a] <= box.max[a]));
			if (isBeside) edge = std::min(edge, sign * (point.state->refPos[axis] - grid.origin[axis]) - point.shape->halfSize0[axis]);
		}
		return edge / grid.cellSize;
	}

	// A face of the box where the soil ends and no line of the grid is: its nodes constrain the soil through cells
	// that are filled in part. Doubt about a little of that; more is refused, as the soil there would be half as
	// stiff and less.
	string faceBetweenLines(const MpmBoundary& box, const vector<MaterialPoint>& points, const MpmGrid& grid, const string& name, int axis, int sign)
	{
		constexpr Real little = 1e-6, most = 0.25; // cells
		const Real     face = sign > 0 ? box.max[axis] : box.min[axis], place = sign * (face - grid.origin[axis]) / grid.cellSize;
		const Real     line = std::floor(place + little);
		if (!std::isfinite(face) || place - line <= little) return "";
		const Real edge = edgeOfSoil(box, points, grid, axis, sign), away = edge - line;
		if (away <= little || edge > place + little) return "";
		const string text = gimpm::sentence(
		        name, sign > 0 ? ".max[" : ".min[", axis, "] = ", face,
		        " m, where the soil ends, is on no line of the grid: the soil is constrained at the next one, ",
		        grid.origin[axis] + sign * line * grid.cellSize, " m, ", away,
		        " cells away, through cells that are filled in part, and is too soft there");
		if (away <= most + little) return text + ". Let MpmGrid.origin and cellSize put a line on it, or give MpmBoundary(surface=...).";
		throw std::invalid_argument(gimpm::sentence(
		        text, "; at most ", most, " cells are admitted. Let MpmGrid.origin and cellSize put a line on it, as by origin[", axis, "] = ", face,
		        ", or give MpmBoundary(surface=...)."));
	}
}

std::map<string, string> MpmBoundary::warnings(const Analysis& analysis, const vector<MaterialPoint>& points, const string& name) const
{
	if (surface || !analysis.grid->hasEqualCells()) return {};
	for (int axis = 0; axis < analysis.grid->dim; ++axis)
		for (const int sign : { 1, -1 })
			if (fixes(axis))
				if (const string text = faceBetweenLines(*this, points, *analysis.grid, name, axis, sign); !text.empty())
					return { { "betweenLines", text } };
	return {};
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
