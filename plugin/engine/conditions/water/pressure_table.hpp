// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The pressure that a function of Python gives, at the nodes around the material points.
#include "core/parallel/division.hpp"
#include "core/terms/water/water_pressure.hpp"
#include "engine/conditions/water/MpmWater.hpp"
#include <algorithm>

namespace yade {

// Time of a pressure: in the state reached, or at the end of the coming step.
enum class When { now, next };

// What a function is still to be asked, about nodes around the cells that the water's table does not have yet.
template <int Dim> class PressureQuestion : public Question {
public:
	PressureQuestion(MpmWater& water, const string& name, const gimpm::Grid<Dim>& grid, const vector<gimpm::Key>& nodes, When when)
	        : water(&water), function(water.pressure), name(name), grid(grid), nodes(nodes), when(when)
	{
	}

	// None if the table has all. std::invalid_argument, in the name given, where something is missing and there is
	// no function any more.
	static std::optional<PressureQuestion> of(MpmWater&, const gimpm::Grid<Dim>&, const vector<gimpm::Key>& cells, const string& name, When);

	// The function may do anything that a script can, so the lock of values must not be held. std::invalid_argument
	// for what it returns or raises.
	void ask() override;

	// Puts the answers into the table.
	void store() const override;

	MpmWater*          water;
	PythonFunction     function;
	string             name;
	gimpm::Grid<Dim>   grid;
	vector<gimpm::Key> nodes;
	When               when;
	vector<Real>       found {};
};

// Pressure of a function at nodes, linear in time from the state reached to the end of the step.
template <int Dim> class PressureInTime {
public:
	using Pressure = std::shared_ptr<const gimpm::WaterPressure<Dim>>;

	// Asks the function at nodes around the cells that the water's tables do not have yet. Studies, whose times are
	// equal, know the state reached only. std::invalid_argument, in the name given, for what the function returns or
	// raises, or where there is no function any more.
	PressureInTime(MpmWater&, const gimpm::Grid<Dim>&, const vector<gimpm::Key>& cells, const string& name, Real begin, Real end);

	Pressure at(Real time) const;

	// Makes the pressure at a time that of the state reached.
	void keep(MpmWater&, Real time) const;

private:
	gimpm::Grid<Dim>   grid;
	vector<gimpm::Key> nodes;
	vector<Real>       before, after;
	gimpm::Vec<Dim>    fallBefore, fallAfter;
	Real               begin, end;

	Real         shareAt(Real time) const { return end > begin ? std::clamp((time - begin) / (end - begin), Real(0), Real(1)) : 1; }
	vector<Real> valuesAt(Real share) const;
};

} // namespace yade
