// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/grid/MpmGrid.hpp"
#include "engine/points/MaterialPoints.hpp"
#include <map>

namespace yade {

// Number of cells in which middles of points lie, by edge length [m]. Points off the grid do not count.
std::map<Real, int> cellsBySize(const MpmGrid&, const vector<MaterialPoint>&);

} // namespace yade
