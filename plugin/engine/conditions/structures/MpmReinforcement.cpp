// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/structures/MpmReinforcement.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/structures/reinforcements.hpp"
#include "yade_api/registration.hpp"

namespace yade {

void MpmReinforcement::requireAdmissible() const
{
	Exposed<MpmReinforcement, MpmCondition>::requireAdmissible();
	const bool isLimited = std::isfinite(bond) || friction > 0;
	if (isLimited != std::isfinite(bondStiffness))
		throw std::invalid_argument(
		        "MpmReinforcement.bondStiffness = " + textOf(bondStiffness) + ", bond = " + textOf(bond) + ", friction = " + textOf(friction)
		        + ": a bar that may slip needs a finite bondStiffness [N/m2] and a bond [N/m] or friction, and one that does not has none of them.");
	if (friction > 0 && !std::isfinite(bond))
		throw std::invalid_argument("MpmReinforcement.friction = " + textOf(friction) + " adds to bond, which is inf: give bond=0 for friction alone.");
	const auto points = placesOf(line);
	const Real first  = (points[1] - points[0]).norm();
	if (freeLength > 0 && !(freeLength < first * (1 - 1e-9)))
		throw std::invalid_argument(
		        "MpmReinforcement.freeLength = " + textOf(freeLength) + " is not admitted: expected less than the length of the first segment of line, "
		        + textOf(first) + " m: the grouted body begins within it.");
	if (pull > 0 && headPlate)
		throw std::invalid_argument(
		        "MpmReinforcement.pull = " + textOf(pull) + ": a head with headPlate=True is fixed to the soil, and cannot be pulled.");
}

void MpmReinforcement::requireFitting(const Analysis& analysis, const string& name) const
{
	requireStructuresFit(analysis, "MpmReinforcement", name);
	if (analysis.grid->axisymmetric)
		throw std::invalid_argument(
		        name + ": MpmReinforcement cannot go with MpmGrid.axisymmetric, where a bar would be a cone. MpmBeam makes a shell there.");
	if (friction > 0 && std::isnan(perimeter) && analysis.grid->dim == 3)
		throw std::invalid_argument(name + ".perimeter [m] must be given with friction where the grid has dim=3.");
	if (freeLength > 0 && !headPlate && pull == 0)
		throw std::invalid_argument(
		        name + ".freeLength = " + textOf(freeLength)
		        + ": nothing supports its head. Give headPlate=True or a pull, or fix it to a wall by MpmBeam.anchors.");
}

std::shared_ptr<Condition<2>> MpmReinforcement::make(InPlane, const Group& group, const Analysis&) const { return std::make_shared<Reinforcements<2>>(group); }
std::shared_ptr<Condition<3>> MpmReinforcement::make(InSpace, const Group& group, const Analysis&) const { return std::make_shared<Reinforcements<3>>(group); }

Real MpmReinforcement::end(const Analysis& analysis) const
{
	return pull > 0 || pretension > 0 ? analysis.curveOfLoad(curve).end() : -std::numeric_limits<Real>::infinity();
}

void MpmReinforcement::tell(Rows& rows, const Analysis&, const Listed& listed) const
{
	rows.set("load" + std::to_string(listed.number) + "_axialForce", axialForces.empty() ? 0 : *std::max_element(axialForces.begin(), axialForces.end()));
}

void MpmReinforcement::draw(Picture& picture, const Analysis&, const Listed& listed) const
{
	const auto& x     = places();
	const int   first = int(picture.corners.size());
	picture.corners.insert(picture.corners.end(), x.begin(), x.end());
	for (int i = 0; i + 1 < int(x.size()); ++i) {
		picture.add({ first + i, first + i + 1 });
		picture.set("axialForce", axialForces.empty() ? 0 : axialForces[i]);
		picture.set("load", int(listed.number));
	}
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmReinforcement)
static const yade::PluginClasses<yade::MpmReinforcement> registeredMpmReinforcement(__FILE__);
