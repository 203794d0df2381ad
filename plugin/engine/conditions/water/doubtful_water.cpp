// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/water/doubtful_water.hpp"
#include "core/base/sentence.hpp"
#include "engine/engines/MpmImplicitEngine.hpp"

namespace yade {

using gimpm::sentence;

namespace {
	// What there is of a body along an axis.
	struct Extent {
		Real low = std::numeric_limits<Real>::infinity(), high = -low;

		void take(Real middle, Real half) { low = std::min(low, middle - half), high = std::max(high, middle + half); }
	};

	// Whether a boundary holds soil at this coordinate along the axis, or a contact may.
	bool isHeld(const MpmImplicitEngine& engine, int axis, Real place)
	{
		const Real near  = engine.grid->cellSize;
		const auto holds = [&](const auto& boundary) {
			if (boundary->surface) return true;
			return boundary->fixes(axis) && boundary->min[axis] <= place + near && boundary->max[axis] >= place - near
			        && (std::isfinite(boundary->min[axis]) || std::isfinite(boundary->max[axis]));
		};
		return !engine.contacts.empty() || std::any_of(engine.boundaries.begin(), engine.boundaries.end(), holds);
	}

	Real highestLevel(const MpmWater& water)
	{
		Real highest = water.level;
		for (const auto& [time, level] : water.levels)
			highest = std::isnan(highest) ? level : std::max(highest, level);
		return highest;
	}
}

string doubtOfWeight(const MpmImplicitEngine& engine)
{
	constexpr Real lightest = 500, earth = 9.81;                                            // N/m3, of a fluid under the gravity of the earth
	const auto     isDensity = [](Real weight) { return weight >= 950 && weight <= 1100; }; // of water, fresh or salt
	if (engine.gravity.norm() <= 1) return "";
	for (size_t i = 0; i < engine.water.size(); ++i) {
		const MpmWater& water = *engine.water[i];
		if (std::isnan(water.level) && water.levels.empty()) continue;
		const string has = sentence("water[", i, "] has weight = ", water.weight, ", in N/m3; was it meant in ");
		if (water.weight < lightest) return sentence(has, "kN/m3, that is ", 1e3 * water.weight, " N/m3?");
		if (isDensity(water.weight) && engine.gravity.norm() > earth / 2)
			return sentence(has, "kg/m3, a density, that is ", earth * water.weight, " N/m3?");
	}
	return "";
}

string doubtOfSides(const MpmImplicitEngine& engine, const vector<MaterialPoint>& points)
{
	const bool isOutside = std::any_of(engine.water.begin(), engine.water.end(), [](const auto& water) { return water->where == "outside"; });
	if (!isOutside || engine.gravity.isZero(0) || engine.grid->axisymmetric || isDivided(engine)) return ""; // of a division no process has all points
	int up = 0;
	engine.gravity.cwiseAbs().maxCoeff(&up);
	const Real sign = engine.gravity[up] > 0 ? -1 : 1;
	Extent     along[3], height;
	for (const MaterialPoint& p : points) {
		for (int a = 0; a < 3; ++a)
			along[a].take(p.state->pos[a], p.shape->halfSize[a]);
		height.take(sign * p.state->pos[up], p.shape->halfSize[up]);
	}
	for (size_t i = 0; i < engine.water.size(); ++i) {
		const Real level = highestLevel(*engine.water[i]);
		if (engine.water[i]->where != "outside" || !(level > height.low && level < height.high)) continue;
		for (int a = 0; a < engine.grid->dim; ++a) {
			if (a == up || engine.grid->period[a] != 0 || isHeld(engine, a, along[a].low) || isHeld(engine, a, along[a].high)) continue;
			return sentence(
			        "water[", i, "], outside of the body up to a level of ", level, " m, presses on both of its sides along ", "xyz"[a],
			        ": a level is that of all water around. For water on one side, as before a dam, give a pressure that is zero on the other one: MpmWater(where='outside', ",
			        "pressure=lambda x: 9810 * max(0, ", level, " - x[", up, "]) if x[", a, "] < ", (along[a].low + along[a].high) / 2,
			        " else 0).");
		}
	}
	return "";
}

} // namespace yade
