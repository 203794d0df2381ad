// SPDX-License-Identifier: GPL-2.0-or-later
// Surfaces and the lines of a grid.
#pragma once
#include "core/grid/grid.hpp"
#include "core/grid/surface.hpp"

namespace gimpm {

/// In the plane, divides pieces where they cross the lines of the grid: so what acts on them evenly acts on the nodes as
/// an even stress does.
template <int Dim> void cutAtLines(Surface<Dim>&, const Grid<Dim>&);

} // namespace gimpm
