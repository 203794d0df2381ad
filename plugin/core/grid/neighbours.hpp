// SPDX-License-Identifier: GPL-2.0-or-later
// Cells beyond the faces of a cell, on grids of equal cells and of several sizes.
#pragma once
#include "core/grid/refinement.hpp"

namespace gimpm {

/// Calls f(neighbour, level of the common face) for the cells beyond a face of a cell, where no line parts the body.
template <int Dim, class F> void forNeighbours(Key cell, int axis, bool isAbove, const Grid<Dim>& grid, F&& f)
{
	if (grid.refinement) return grid.refinement->forLeavesBeyond(cell, axis, isAbove, f);
	const Key step = Grid<Dim>::keyStep(axis);
	f(grid.first(isAbove ? cell + step : cell - step), 0);
}

} // namespace gimpm
