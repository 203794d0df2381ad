// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The pressure that a function of Python gives, at the nodes around the material points.
#include "core/grid/division.hpp"
#include "core/terms/water_pressure.hpp"
#include "engine/conditions/MpmWater.hpp"

namespace yade {

// Cells that hold the middle of a point, in a row; of a division, those of all processes.
template <int Dim> vector<gimpm::Key> cellsOf(const gimpm::PointCloud<Dim>&, const gimpm::Grid<Dim>&, const gimpm::Division*);

// Asks the function at nodes around the cells that the water's table does not have yet. std::invalid_argument, in the name given, for what it returns or raises, or where there is no
// function any more.
template <int Dim>
std::shared_ptr<const gimpm::WaterPressure<Dim>> tabulated(MpmWater&, const gimpm::Grid<Dim>&, const vector<gimpm::Key>& cells, const string& name);

} // namespace yade
