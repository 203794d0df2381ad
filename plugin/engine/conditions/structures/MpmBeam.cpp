// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/structures/MpmBeam.hpp"
#include "core/base/sentence.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/structures/beams.hpp"
#include "engine/conditions/structures/reinforcements.hpp"
#include "yade_api/registration.hpp"

namespace yade {

namespace {
	Real ofLargestSize(const vector<Real>& values)
	{
		const auto at = std::max_element(values.begin(), values.end(), [](Real a, Real b) { return std::abs(a) < std::abs(b); });
		return at == values.end() ? 0 : *at;
	}
}

std::array<bool, 3> MpmBeam::fixed(const string& letters)
{
	const auto has = [&](char letter) { return letters.find(letter) != string::npos; };
	return { has('x'), has('y'), has('r') };
}

void MpmBeam::requireAdmissible() const
{
	Exposed<MpmBeam, MpmCondition>::requireAdmissible();
	if (line.front() == line.back() && line.size() < 4)
		throw std::invalid_argument(
		        "MpmBeam.line = " + textOf(line) + ": a ring, whose last point is its first, needs three different points or more.");
	if (!(prestress > -axialStiffness))
		throw std::invalid_argument(
		        "MpmBeam.prestress = " + textOf(prestress) + " would press it to nothing: expected more than -axialStiffness, which is "
		        + textOf(axialStiffness) + ".");
	for (size_t i = 0; i < anchors.size(); ++i) {
		const string name = "MpmBeam.anchors[" + std::to_string(i) + "]";
		if (!anchors[i]) throw std::invalid_argument(name + " is None: expected an MpmReinforcement.");
		anchors[i]->requireAdmissible();
		if (anchors[i]->pull > 0 || anchors[i]->headPlate)
			throw std::invalid_argument(name + " has a pull or a headPlate: its head is fixed to the beam; stress it by pretension.");
		if (std::count(anchors.begin(), anchors.end(), anchors[i]) > 1) throw std::invalid_argument(name + " is listed twice.");
	}
}

void MpmBeam::requireFitting(const Analysis& analysis, const string& name) const
{
	requireStructuresFit(analysis, "MpmBeam", name);
	if (analysis.grid->dim == 3) throw std::invalid_argument(name + ": an MpmBeam lies in the plane, and the grid has dim=3; there are no plates yet.");
	if (analysis.grid->axisymmetric) requireShell(name);
	else if (poisson > 0)
		throw std::invalid_argument(
		        name + ".poisson = " + textOf(poisson)
		        + " is that of a shell of revolution: a beam in the plane has none. Without MpmGrid.axisymmetric leave it 0.");
	if (weight > 0 && analysis.gravity.isZero(0))
		throw std::invalid_argument(name + ".weight = " + textOf(weight) + " acts along MpmImplicitEngine.gravity, which is zero.");
}

std::optional<std::pair<Vector3r, Vector3r>> MpmBeam::extent() const
{
	const auto places = placesOf(line);
	Vector3r   low = places.front(), high = low;
	for (const Vector3r& x : places) {
		low  = low.cwiseMin(x);
		high = high.cwiseMax(x);
	}
	return std::pair { low, high };
}

string MpmBeam::idleness(const string& name, bool reaches) const
{
	if (reaches) return "";
	const auto [low, high] = *extent();
	return gimpm::sentence(
	        " ", name, ", an MpmBeam from (", low.head<2>().transpose(), ") to (", high.head<2>().transpose(),
	        "), is in the air: no material point is beside it.");
}

// Its line is a meridian, on the one side of the axis.
void MpmBeam::requireShell(const string& name) const
{
	const auto     places   = placesOf(line);
	const auto     inside   = std::find_if(places.begin(), places.end(), [](const Vector3r& x) { return x[0] < 0; });
	const auto     isOnAxis = [](const Vector3r& x) { return x[0] == 0; };
	const Vector3r head     = placesOf(line).front();
	string         what;
	if (inside != places.end()) what = ".line has a point at " + textOf(*inside) + ": around an axis x is a radius, and is not below 0";
	else if (std::adjacent_find(places.begin(), places.end(), [&](const auto& a, const auto& b) { return isOnAxis(a) && isOnAxis(b); }) != places.end())
		what = ".line has two points on the axis one after the other: a shell of revolution has a radius between them";
	else if (places.size() > 2 && std::any_of(places.begin() + 1, places.end() - 1, isOnAxis))
		what = ".line goes through the axis: let it begin or end there";
	else if (std::isfinite(plasticMoment))
		what = ".plasticMoment = " + textOf(plasticMoment) + ": a shell of revolution does not yield; leave it inf. Hinges are admitted";
	else if (prestress != 0)
		what = ".prestress = " + textOf(prestress) + " is that of a beam in the plane: a shell of revolution comes in without stress";
	else if (contraction > 0)
		what = ".contraction = " + textOf(contraction) + " is that of a ring in the plane: a shell of revolution does not contract";
	else if (!anchors.empty())
		what = ".anchors: around an axis they would be cones, and are not admitted";
	else if (isOnAxis(head) && (headForce[0] != 0 || headMoment != 0))
		what = ": its first vertex is on the axis, where headForce has a y alone and headMoment is 0";
	if (!what.empty()) throw std::invalid_argument(name + what + ".");
	for (const Vector3r& hinge : placesOf(hinges))
		if (isOnAxis(hinge)) throw std::invalid_argument(name + ".hinges has " + textOf(hinge) + ", a point on the axis, where nothing turns.");
}

std::shared_ptr<Condition<2>> MpmBeam::make(InPlane, const Group& group, const Analysis&) const { return std::make_shared<Beams>(group); }

Real MpmBeam::end(const Analysis& analysis) const
{
	Real last = headForce.isZero(0) && headMoment == 0 && contraction == 0 ? -std::numeric_limits<Real>::infinity() : analysis.curveOfLoad(curve).end();
	for (const auto& anchor : anchors)
		last = std::max(last, anchor->end(analysis));
	return last;
}

void MpmBeam::tell(Rows& rows, const Analysis& analysis, const Listed& listed) const
{
	const string name = "load" + std::to_string(listed.number);
	rows.set(name + "_axialForce", ofLargestSize(axialForces));
	rows.set(name + "_shearForce", ofLargestSize(shearForces));
	rows.set(name + "_moment", ofLargestSize(moments));
	if (analysis.grid->axisymmetric) {
		rows.set(name + "_hoopForce", ofLargestSize(hoopForces));
		rows.set(name + "_hoopMoment", ofLargestSize(hoopMoments));
	}
	for (size_t i = 0; i < anchors.size(); ++i)
		rows.set(name + "_anchor" + std::to_string(i), ofLargestSize(anchors[i]->axialForces));
}

void MpmBeam::draw(Picture& picture, const Analysis& analysis, const Listed& listed) const
{
	const auto x     = vertices.empty() ? placesOf(line) : vertices;
	const int  first = int(picture.corners.size());
	picture.corners.insert(picture.corners.end(), x.begin(), x.end());
	for (int i = 0; i + 1 < int(x.size()); ++i) {
		picture.add({ first + i, first + i + 1 });
		picture.set("axialForce", axialForces.empty() ? 0 : axialForces[i]);
		picture.set("shearForce", shearForces.empty() ? 0 : shearForces[i]);
		picture.set("moment", moments.empty() ? 0 : (moments[i] + moments[i + 1]) / 2);
		if (!hoopForces.empty()) {
			picture.set("hoopForce", hoopForces[i]);
			picture.set("hoopMoment", (hoopMoments[i] + hoopMoments[i + 1]) / 2);
		}
		picture.set("load", int(listed.number));
	}
	for (const auto& anchor : anchors)
		anchor->draw(picture, analysis, listed);
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmBeam)
static const yade::PluginClasses<yade::MpmBeam> registeredMpmBeam(__FILE__);
