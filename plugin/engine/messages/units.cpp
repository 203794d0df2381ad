// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/messages/units.hpp"
#include "core/base/sentence.hpp"
#include <algorithm>

namespace yade {

namespace {
	using gimpm::sentence;

	struct Unit {
		const char* name;
		Real        size; // in SI units
	};
	constexpr Real     earth = 9.81; // m/s2; a weight per volume divided by it is a density
	const vector<Unit> unitsOfDensity { { "t/m3", 1e3 }, { "kN/m3, a unit weight", 1e3 / earth }, { "N/m3, a unit weight", 1 / earth }, { "t/mm3", 1e12 } };
	const vector<Unit> unitsOfStress { { "kPa", 1e3 }, { "MPa", 1e6 }, { "GPa", 1e9 } };

	// Those units in which the number would be between two limits, in SI units.
	string meant(Real value, const vector<Unit>& units, Real least, Real most, const char* unit)
	{
		string names, values;
		for (const Unit& one : units) {
			const Real inUnits = value * one.size;
			if (inUnits < least || inUnits > most) continue;
			names += (names.empty() ? "" : " or ") + string(one.name);
			values += (values.empty() ? "" : " or ") + sentence(inUnits);
		}
		return names.empty() ? "; was another unit meant?" : "; was it meant in " + names + ", that is " + values + " " + unit + "?";
	}

	// Lighter than peat under water or heavier than copper; in between are foams and metals, which ground may be
	// beside.
	string warningOfDensity(Real density)
	{
		constexpr Real lightest = 50, heaviest = 9000, lightestGround = 750, heaviestGround = 4000; // kg/m3
		if (density >= lightest && density <= heaviest) return "";
		return sentence("density = ", density, ", in kg/m3", meant(density, unitsOfDensity, lightestGround, heaviestGround, "kg/m3"));
	}

	string warningOfModulus(const MpmMaterial& material)
	{
		// Pa, kg/m3, Pa.
		constexpr Real softest = 1e5, ofGround = 500, softestGround = 2e5, stiffestGround = 1e11;
		if (material.density <= ofGround) return "";
		for (const auto& [name, value] : material.moduli())
			if (value < softest) return sentence(name, " = ", value, ", in Pa", meant(value, unitsOfStress, softestGround, stiffestGround, "Pa"));
		return "";
	}

	// Beside the stress that the weight of the body gives.
	string warningOfStrength(const MpmMaterial& material, Real stress)
	{
		constexpr Real least = 0.005, leastMeant = 0.02, mostMeant = 100;
		for (const auto& [name, value] : material.strengths())
			if (value < least * stress)
				return sentence(
				        name, " = ", value, ", in Pa, which is ", value / stress, " times the stress that its weight gives, ", stress, " Pa",
				        meant(value, unitsOfStress, leastMeant * stress, mostMeant * stress, "Pa"));
		return "";
	}

	// Warning about units of a material. If points have strengths or moduli of their own, those of the material
	// need not be anybody's.
	string warningOf(const MpmMaterial& material, bool varies, Real gravity, Real height)
	{
		const string density = warningOfDensity(material.density);
		if (!density.empty() || varies) return density;
		const string modulus = warningOfModulus(material);
		return modulus.empty() ? warningOfStrength(material, material.density * gravity * height) : modulus;
	}
}

string warningOfUnits(
        const Vector3r& gravity, Real height, const vector<MaterialPoint>& points, const vector<int>& index, const vector<gimpm::Material>& materials)
{
	if (gravity.norm() <= 1) return "";
	for (size_t m = 0; m < materials.size(); ++m) {
		const size_t first = std::find(index.begin(), index.end(), int(m)) - index.begin();
		if (first >= points.size()) continue; // another process has them
		const MaterialPoint& point = points[first];
		if (point.material->share != 1) continue; // stage of construction, which makes it light, and soft
		const string warning = warningOf(*point.material, materials[m].varies, gravity.norm(), height);
		if (!warning.empty()) return sentence("material '", point.material->label, "' (of body #", point.id, ") has ", warning);
	}
	return "";
}

} // namespace yade
