// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/division.hpp"
#include "core/base/even_parts.hpp"
#include <algorithm>
#include <numeric>

namespace gimpm {
namespace {

/// Of the points and the node of a cell.
double workOf(double points, double cells, double pointsOfCell) { return solveOverAssembly * cells + points / pointsOfCell; }

} // namespace

std::vector<int> Division::startsAmong(const std::vector<Key>& sorted) const
{
	std::vector<int> start { 0 };
	for (const Key key : first)
		start.push_back(position(sorted, key));
	start.push_back(int(sorted.size()));
	return start;
}

std::vector<Key> Division::united(const std::vector<Key>& sorted) const
{
	const auto start = startsAmong(sorted);
	const int  rank  = processes->rank();
	return joined(*processes, std::vector<Key>(sorted.begin() + start[rank], sorted.begin() + start[rank + 1]));
}

double Division::sum(double own) const
{
	addUp(*processes, &own, 1);
	return own;
}

double Division::largest(double own) const
{
	const auto numbers = ofEach(*processes, own);
	return *std::max_element(numbers.begin(), numbers.end());
}

template <int Dim> Key lowestCell(const Vec<Dim>& position, const Vec<Dim>& halfSize, const Grid<Dim>& grid, Basis basis)
{
	Index<Dim> lowest;
	for (int a = 0; a < Dim; ++a) {
		const double x = position[a] - grid.origin[a];
		lowest[a]      = basis == Basis::gimp ? AxisCells::reached(x, halfSize[a], grid.cellSize).lowest : centreCell(x, grid.cellSize);
	}
	return Grid<Dim>::key(grid.first(lowest));
}

std::vector<Key> cutByWork(std::vector<CellLoad> loads, int processes)
{
	std::sort(loads.begin(), loads.end(), [](const CellLoad& a, const CellLoad& b) { return a.lowest < b.lowest; });
	std::vector<CellLoad> cells; // of which several processes may have points
	for (const CellLoad& load : loads)
		if (!cells.empty() && cells.back().lowest == load.lowest) cells.back().points += load.points;
		else
			cells.push_back(load);
	const double        points = std::accumulate(cells.begin(), cells.end(), 0., [](double sum, const CellLoad& cell) { return sum + cell.points; });
	std::vector<double> work;
	for (const CellLoad& cell : cells)
		work.push_back(workOf(cell.points, 1, points / double(cells.size())));
	const auto       start = evenParts(work, processes);
	std::vector<Key> first;
	for (int r = 1; r < processes; ++r)
		first.push_back(start[r] < int(cells.size()) ? cells[start[r]].lowest : ~Key(0));
	return first;
}

double imbalance(const Processes& all, const std::vector<CellLoad>& own)
{
	double points = 0;
	for (const auto& load : own)
		points += load.points;
	const auto   pointsOf = ofEach(all, points), cellsOf = ofEach(all, double(own.size()));
	const double allPoints = std::accumulate(pointsOf.begin(), pointsOf.end(), 0.), allCells = std::accumulate(cellsOf.begin(), cellsOf.end(), 0.);
	double       most = 0;
	for (std::size_t r = 0; r < pointsOf.size(); ++r)
		most = std::max(most, workOf(pointsOf[r], cellsOf[r], allPoints / allCells));
	return most * double(pointsOf.size()) / workOf(allPoints, allCells, allPoints / allCells) - 1;
}

template <int Dim> std::vector<int> neededBy(const Division& division, Key lowest, const Grid<Dim>& grid, bool isWide)
{
	const int        below = isWide ? -1 : 0, above = isWide ? 3 : 2, wide = above - below + 1; // nodes along an axis
	std::vector<int> needed;
	for (int n = 0; n < (Dim == 2 ? wide * wide : wide * wide * wide); ++n) {
		Key node = lowest;
		for (int a = 0, rest = n; a < Dim; ++a, rest /= wide)
			node += Key(std::int64_t(below + rest % wide)) * Grid<Dim>::keyStep(a);
		if (const int holder = division.holderOf(grid.first(node)); needed.empty() || needed.back() != holder) needed.push_back(holder);
	}
	std::sort(needed.begin(), needed.end());
	needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
	return needed;
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template Key              lowestCell(const Vec<Dim>&, const Vec<Dim>&, const Grid<Dim>&, Basis);                                                       \
	template std::vector<int> neededBy<Dim>(const Division&, Key, const Grid<Dim>&, bool);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
