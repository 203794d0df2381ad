// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/stepping/model.hpp"
#include "engine/conditions/MpmBoundary.hpp"
#include "engine/conditions/MpmTraction.hpp"
#include "engine/conditions/MpmWater.hpp"
#include "yade_api/exposed.hpp"

namespace yade {

// What acts on the points over time, as an engine is told.
struct Loads {
	Vector3r                        gravity = Vector3r::Zero();
	gimpm::LoadCurve::Knees         loadCurve { { 0, 0 }, { 1, 1 } };
	gimpm::LoadCurve::Knees         gravityCurve; // empty: loadCurve
	vector<shared_ptr<MpmTraction>> loads;
	vector<shared_ptr<MpmWater>>    water;
	vector<shared_ptr<MpmBoundary>> boundaries;

	// Attributes, as those of a class.
	template <class V> static void attributes(V&& v)
	{
		v("gravity", &Loads::gravity, 0, "Acceleration [m/s²] of all material points at load factor 1, finite.", finite);
		v("loadCurve", &Loads::loadCurve, 0,
		  "Load factor [-] as a sequence of (time [s], factor), times increasing; linear between, constant before and after. Multiplies gravity (but see "
		  "*gravityCurve*), point loads and prescribed displacements.",
		  admitting("one or more (time, factor), all finite, with increasing times", gimpm::LoadCurve::isAdmissible));
		v("gravityCurve", &Loads::gravityCurve, 0,
		  "Factor [-] of gravity as *loadCurve*, where it shall not go with the other loads; empty, the default: it does. [(0, 1)]: gravity acts from the "
		  "beginning, as after mpm.geostatic.",
		  curveOrNothing);
		v("loads", &Loads::loads, 0, "Loads on surfaces of the body (MpmTraction); read as a tuple, so assign a new one to change it.");
		v("water", &Loads::water, 0,
		  "Water in the pores and around the body (MpmWater); several add up. Read as a tuple, so assign a new one to change it.");
	}

	gimpm::LoadCurve curveOfLoads() const { return gimpm::LoadCurve(loadCurve); }
	gimpm::LoadCurve curveOfGravity() const { return gimpm::LoadCurve(gravityCurve.empty() ? loadCurve : gravityCurve); }

	gimpm::LoadCurve curveOf(const MpmTraction& load) const { return load.curve.empty() ? curveOfLoads() : gimpm::LoadCurve(load.curve); }

	gimpm::LoadCurve curveOf(const MpmBoundary& boundary) const { return boundary.curve.empty() ? curveOfLoads() : gimpm::LoadCurve(boundary.curve); }

	gimpm::LoadCurve curveOf(const MpmWater& one) const { return one.curve.empty() ? curveOfGravity() : gimpm::LoadCurve(one.curve); }

	// When the last of them has come to rest.
	Real loadsEnd() const
	{
		Real end = std::max(curveOfLoads().end(), curveOfGravity().end());
		for (const auto& load : loads)
			end = std::max(end, curveOf(*load).end());
		for (const auto& boundary : boundaries)
			end = std::max(end, curveOf(*boundary).end());
		for (const auto& one : water)
			end = std::max({ end, curveOf(*one).end(), one->levels.empty() ? end : gimpm::LoadCurve(one->levels).end() });
		return end;
	}

	template <int Dim> gimpm::Load<Dim> loadBetween(Real begin, Real end) const
	{
		gimpm::Load<Dim> load { gravity.head<Dim>(), curveOfLoads().between(begin, end) };
		load.duration = end - begin;
		if (!gravityCurve.empty()) load.ofGravity = curveOfGravity().between(begin, end);
		for (size_t b = 0; b < boundaries.size(); ++b)
			if (!boundaries[b]->curve.empty()) load.ofBoxes[int(b)] = curveOf(*boundaries[b]).between(begin, end);
		return load;
	}
};

} // namespace yade
