// SPDX-License-Identifier: GPL-2.0-or-later
// Cells beyond the faces of a cell, on grids of equal cells and of several sizes, and where lines part the body.
#pragma once
#include "core/grid/parting.hpp"

namespace gimpm {

/// Calls f(neighbour, level of the common face) for the cells beyond a face of a cell, in its layer.
template <int Dim, class F> void forNeighbours(Key cell, int axis, bool isAbove, const Grid<Dim>& grid, F&& f)
{
	if (grid.refinement) return grid.refinement->forLeavesBeyond(cell, axis, isAbove, f);
	const Key step = Grid<Dim>::keyStep(axis);
	f(grid.first(isAbove ? cell + step : cell - step), 0);
}

/// Calls f(cell, layer of the common face) for the cells that stand for a neighbour.
template <int Dim, class F> void forSidesOf(Key cell, Key neighbour, const Grid<Dim>& grid, F&& f)
{
	if (grid.parting) return grid.parting->forSidesBeyond(cell, neighbour, f);
	f(neighbour, Grid<Dim>::layer(cell));
}

/// Calls f(cell above a face of a cell, cell below the face in the layer and of the level of its nodes): of two sizes
/// the smaller cell's face is meant, and the cell below, or the one above it, is part of the larger one.
template <int Dim, class F> void forCellsAbove(Key cell, int axis, const Grid<Dim>& grid, F&& f)
{
	forNeighbours(cell, axis, true, grid, [&](Key neighbour, int level) {
		const Key lower = level < Grid<Dim>::level(cell) ? neighbour - Grid<Dim>::keyStep(axis, level) : cell;
		forSidesOf(cell, neighbour, grid, [&](Key above, int layer) { f(above, grid.parting ? Parting<Dim>::in(layer, lower) : lower); });
	});
}

} // namespace gimpm
