// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The pressure that a function of Python gives, at the nodes around the material points.
#include "core/parallel/division.hpp"
#include "core/terms/water/water_pressure.hpp"
#include "engine/conditions/water/MpmWater.hpp"
#include "engine/conditions/water/walls_in_water.hpp"
#include <algorithm>
#include <map>

namespace yade {

// Time of a pressure: in the state reached, or at the end of the coming step.
enum class When { now, next };

// Question to a function about nodes around the cells, and positions beside walls, that the water's tables
// do not have yet.
template <int Dim> class PressureQuestion : public Question {
public:
	// None if the tables have all. std::invalid_argument, in the name given, where something is missing and there
	// is no function any more.
	static std::optional<PressureQuestion> of(
	        MpmWater&, const gimpm::Grid<Dim>&, const vector<gimpm::Key>& cells, const string& name, When, const vector<WallInWater>&);

	// The function may do anything that a script can, so the lock of values must not be held. std::invalid_argument
	// for what it returns or raises.
	void ask() override;

	// Puts the answers into the tables.
	void store() const override;

private:
	MpmWater*                 water;
	PythonFunction            function;
	string                    name;
	gimpm::Grid<Dim>          grid;
	When                      when;
	vector<gimpm::Key>        nodes {};
	vector<WallInWater::Vec2> places {};
	vector<Real>              found {}; // at nodes, then at positions

	PressureQuestion(MpmWater& water, const string& name, const gimpm::Grid<Dim>& grid, When when)
	        : water(&water), function(water.pressure), name(name), grid(grid), when(when)
	{
	}
};

// Pressure of a function, linear in time from the state reached to the end of the step.
template <int Dim> class PressureInTime {
public:
	using Pressure = std::shared_ptr<const gimpm::WaterPressure<Dim>>;
	using Places   = std::map<std::pair<Real, Real>, Real>; // pressures beside walls

	// Asks the function where the water's tables do not have pressures yet. Studies, whose times are equal, know
	// the state reached only. std::invalid_argument, in the name given, for what the function returns or raises, or
	// where there is no function any more.
	PressureInTime(
	        MpmWater&, const gimpm::Grid<Dim>&, const vector<gimpm::Key>& cells, const string& name, Real begin, Real end, const vector<WallInWater>&);

	Pressure at(Real time) const;

	// Left of each vertex of a wall less right of it; empty: there is no jump.
	vector<Real> jumps(const WallInWater&, Real time) const;

	// The pressure as it goes on from a side of a wall (0 left, 1 right).
	Pressure beside(const WallInWater&, int side, Real time) const;

	// Makes the pressure at a time that of the state reached.
	void keep(MpmWater&, Real time) const;

private:
	gimpm::Grid<Dim>   grid;
	vector<gimpm::Key> nodes;
	vector<Real>       before, after;
	Places             besideBefore, besideAfter;
	gimpm::Vec<Dim>    fallBefore, fallAfter;
	Real               begin, end;

	Real         shareAt(Real time) const { return end > begin ? std::clamp((time - begin) / (end - begin), Real(0), Real(1)) : 1; }
	vector<Real> valuesAt(Real share) const;
	Pressure     tabulated(const vector<Real>& values, Real share) const;
	Real         besideAt(const WallInWater::Vec2& place, Real share) const;
};

} // namespace yade
