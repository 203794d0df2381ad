// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The pressure that a function of Python gives, at the nodes around the material points.
#include "core/parallel/division.hpp"
#include "core/terms/water/water_pressure.hpp"
#include "engine/conditions/water/MpmWater.hpp"

namespace yade {

// What a function is still to be asked, about nodes around the cells that the water's table does not have yet.
template <int Dim> class PressureQuestion : public Question {
public:
	PressureQuestion(MpmWater& water, const string& name, const gimpm::Grid<Dim>& grid, const vector<gimpm::Key>& nodes)
	        : water(&water), function(water.pressure), name(name), grid(grid), nodes(nodes)
	{
	}

	// None if the table has all. std::invalid_argument, in the name given, where something is missing and there is
	// no function any more.
	static std::optional<PressureQuestion> of(MpmWater&, const gimpm::Grid<Dim>&, const vector<gimpm::Key>& cells, const string& name);

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
	vector<Real>       found {};
};

// Asks the function at nodes around the cells that the water's table does not have yet. std::invalid_argument, in the
// name given, for what it returns or raises, or where there is no function any more.
template <int Dim>
std::shared_ptr<const gimpm::WaterPressure<Dim>> tabulated(MpmWater&, const gimpm::Grid<Dim>&, const vector<gimpm::Key>& cells, const string& name);

} // namespace yade
