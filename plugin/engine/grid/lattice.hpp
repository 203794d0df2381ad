// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Checks that points were made for the grid that they are computed on.
#include "core/grid/grid.hpp"
#include "engine/points/MaterialPoints.hpp"

namespace yade {

// mpm.fill puts a whole number of points into a cell and along each axis, also into cells that are halved, and so do
// points that are split. Fills of other lattices may lie beside those of the grid; where not a single point belongs to
// it, a sentence says so. Else it is empty.
template <int Dim> string warningOfLattice(const vector<MaterialPoint>&, const gimpm::Grid<Dim>&);

} // namespace yade
