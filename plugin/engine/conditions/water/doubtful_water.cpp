// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/water/doubtful_water.hpp"
#include "core/base/sentence.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/water/MpmWater.hpp"

namespace yade {

using gimpm::sentence;

namespace {
	// Extent of a body along an axis.
	struct Extent {
		Real low = std::numeric_limits<Real>::infinity(), high = -low;

		void take(Real middle, Real half) { low = std::min(low, middle - half), high = std::max(high, middle + half); }
	};

	// True if anything constrains soil at this coordinate along the axis, or may.
	bool isConstrained(const Analysis& analysis, int axis, Real place)
	{
		const auto all = analysis.conditions();
		return std::any_of(
		        all.begin(), all.end(), [&](const Listed& listed) { return listed.condition->mayHold(axis, place, analysis.grid->cellSize); });
	}

	Real highestLevel(const MpmWater& water)
	{
		Real highest = water.level;
		for (const auto& [time, level] : water.levels)
			highest = std::isnan(highest) ? level : std::max(highest, level);
		return highest;
	}
}

string warningOfWeight(const MpmWater& water, const Analysis& analysis, const string& name)
{
	// N/m3, of a fluid under the gravity of the earth.
	constexpr Real lightest = 500, earth = 9.81;
	// Density of water, fresh or salt.
	const auto isDensity = [](Real weight) { return weight >= 950 && weight <= 1100; };
	if (analysis.gravity.norm() <= 1 || water.hasFunction()) return "";
	const string has = sentence(name, " has weight = ", water.weight, ", in N/m3; was it meant in ");
	if (water.weight < lightest) return sentence(has, "kN/m3, that is ", 1e3 * water.weight, " N/m3?");
	if (isDensity(water.weight) && analysis.gravity.norm() > earth / 2) return sentence(has, "kg/m3, a density, that is ", earth * water.weight, " N/m3?");
	return "";
}

string warningOfSides(const MpmWater& water, const Analysis& analysis, const vector<MaterialPoint>& points, const string& name)
{
	const Real level = highestLevel(water);
	if (water.where != "outside" || analysis.gravity.isZero(0) || analysis.grid->axisymmetric) return "";
	int up = 0;
	analysis.gravity.cwiseAbs().maxCoeff(&up);
	const Real sign = analysis.gravity[up] > 0 ? -1 : 1;
	Extent     along[3], height;
	for (const MaterialPoint& p : points) {
		for (int a = 0; a < 3; ++a)
			along[a].take(p.state->pos[a], p.shape->halfSize[a]);
		height.take(sign * p.state->pos[up], p.shape->halfSize[up]);
	}
	if (!(level > height.low && level < height.high)) return "";
	for (int a = 0; a < analysis.grid->dim; ++a) {
		if (a == up || analysis.grid->period[a] != 0 || isConstrained(analysis, a, along[a].low) || isConstrained(analysis, a, along[a].high)) continue;
		return sentence(
		        name, ", outside of the body up to a level of ", level, " m, presses on both of its sides along ", "xyz"[a],
		        ": a level is that of all water around. For water on one side, as before a dam, give a pressure that is zero on the other one: MpmWater(where='outside', ",
		        "pressure=lambda x: 9810 * max(0, ", level, " - x[", up, "]) if x[", a, "] < ", (along[a].low + along[a].high) / 2, " else 0).");
	}
	return "";
}

string warningOfLostFunction(const MpmWater& water, const string& name)
{
	if (!water.hasFunction() || water.pressure) return "";
	return name
	        + ".pressure is a function, which files do not keep: the pressure stays as it was when the scene was saved. If it changes with time, give "
	          "MpmWater.pressure again.";
}

} // namespace yade
