// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/refinement.hpp"

namespace gimpm {
namespace {

/// Coordinate of the cell of a level along one axis that holds a position, both in smallest cells.
int cellAt(double x, int level) { return int(std::floor(std::ldexp(x, -level))) * (1 << level); }

} // namespace

template <int Dim> Refinement<Dim>::Refinement(const std::vector<RefinedBox<Dim>>& boxes, const Grid<Dim>& grid)
{
	for (const auto& box : boxes)
		largest_ = std::max(largest_, box.halvings);
	const double smallest = grid.cellSize / (1 << largest_), end = Grid<Dim>::endOfKeys;
	const auto   onLine = [&](const Vec<Dim>& x) {
                Vec<Dim> of;
                for (int a = 0; a < Dim; ++a)
                        of[a] = grid.onLine(x[a], a) * (1 << largest_);
                return of;
	};
	for (const auto& box : boxes) {
		const int      level = largest_ - box.halvings + 1; // level of the cells that are halved last
		const auto     cells = [&](const Vec<Dim>& x) { return ((x - grid.origin) / smallest).cwiseMax(-end).cwiseMin(end).eval(); };
		const Vec<Dim> low = cells(box.min) + onLine(box.min), high = cells(box.max) - onLine(box.max);
		Block          block;
		for (int a = 0; a < Dim; ++a) {
			block.lower[a] = cellAt(low[a], level);
			block.upper[a] = std::max(cellAt(high[a], level), block.lower[a]);
		}
		halve(block, level);
	}
}

/// Halves cells with those around them, as large ones of the next level.
template <int Dim> void Refinement<Dim>::halve(Block block, int level)
{
	for (; level <= largest_; ++level) {
		halved_[level].push_back(block);
		for (int a = 0; a < Dim; ++a) {
			block.lower[a] = floorTo(block.lower[a] - (1 << level), level + 1);
			block.upper[a] = floorTo(block.upper[a] + (1 << level), level + 1);
		}
	}
}

template <int Dim> int Refinement<Dim>::levelIn(const Vec<Dim>& low, const Vec<Dim>& high) const
{
	const auto overlapsHalved = [&](int level) {
		for (const Block& block : halved_[level]) {
			bool overlaps = true;
			for (int a = 0; a < Dim; ++a)
				overlaps = overlaps && high[a] >= block.lower[a] && low[a] <= block.upper[a] + (1 << level);
			if (overlaps) return true;
		}
		return false;
	};
	int level = largest_;
	while (level > 0 && overlapsHalved(level))
		--level;
	return level;
}

template <int Dim> int Refinement<Dim>::largestAt(const Index<Dim>& node) const
{
	int level = 0;
	for (int c = 0; c < 1 << Dim; ++c) {
		Index<Dim> cell = node;
		for (int a = 0; a < Dim; ++a)
			cell[a] -= c >> a & 1;
		level = std::max(level, Grid<Dim>::level(leafOf(Grid<Dim>::key(cell))));
	}
	return level;
}

template class Refinement<2>;
template class Refinement<3>;

} // namespace gimpm
