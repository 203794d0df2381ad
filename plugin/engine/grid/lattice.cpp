// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/grid/lattice.hpp"
#include "core/base/sentence.hpp"
#include "core/grid/refinement.hpp"
#include <algorithm>

namespace yade {

namespace {
	bool isWholeNumber(Real number) { return std::abs(number - std::round(number)) < 1e-4; }

	// Points per cell and axis, and the place of the point in the lattice of points, which begins at the origin.
	template <int Dim> struct InCells {
		gimpm::Vec<Dim> number, place;

		InCells(const MaterialPoint& point, const gimpm::Grid<Dim>& grid)
		{
			const gimpm::Vec<Dim> x = point.state->refPos.head<Dim>(), size = 2 * point.shape->halfSize0.head<Dim>();
			number = (2 * gimpm::largestHalf<Dim>(grid, x)) * size.cwiseInverse();
			place  = (x - grid.origin).cwiseQuotient(size).array() - 0.5;
		}
		bool areWhole() const { return std::all_of(number.begin(), number.end(), isWholeNumber); }
		bool isOnLattice() const { return areWhole() && std::all_of(place.begin(), place.end(), isWholeNumber); }
	};
}

template <int Dim> string warningOfLattice(const vector<MaterialPoint>& points, const gimpm::Grid<Dim>& grid)
{
	// Points that have been deformed may count displacements from where they were then, as after
	// mpm.stages.resetDisplacements.
	if (points.empty()) return "";
	const bool areDeformed = !points.front().state->defGrad.isIdentity(1e-12);
	if (areDeformed || std::any_of(points.begin(), points.end(), [&](const MaterialPoint& point) { return InCells<Dim>(point, grid).isOnLattice(); }))
		return "";
	const MaterialPoint&  first = points.front();
	const InCells<Dim>    inCells(first, grid);
	const gimpm::Vec<Dim> size = 2 * first.shape->halfSize0.head<Dim>(), x = first.state->refPos.head<Dim>();
	const string          point = gimpm::sentence("body #", first.id, ", ", size[0], " m wide, at first at (", x.transpose(), ")");
	const string          meant = " Was mpm.fill given another MpmGrid than the engine? Both should have the same.";
	if (!inCells.areWhole())
		return gimpm::sentence(
		        "no material point is of a size that fits into the cells of the engine's grid: ", point, ", is one of ", inCells.number[0],
		        " in a cell and along an axis (cellSize = ", 2 * gimpm::largestHalf<Dim>(grid, x), " m), where mpm.fill puts a whole number.", meant);
	return gimpm::sentence(
	        "no material point is where mpm.fill would have put it with the engine's grid: the box of ", point,
	        ", lies across the lines of the grid, which has origin = (", grid.origin.transpose(), ") and cellSize = ", 2 * gimpm::largestHalf<Dim>(grid, x),
	        " m.", meant);
}

template string warningOfLattice<2>(const vector<MaterialPoint>&, const gimpm::Grid<2>&);
template string warningOfLattice<3>(const vector<MaterialPoint>&, const gimpm::Grid<3>&);

} // namespace yade
