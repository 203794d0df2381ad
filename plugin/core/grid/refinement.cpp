// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/refinement.hpp"
#include <algorithm>

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
	for (auto& cells : cells_) {
		std::sort(cells.begin(), cells.end());
		cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
	}
}

/// Halves cells with those around them, as large ones of the next level.
template <int Dim> void Refinement<Dim>::halve(Block block, int level)
{
	for (; level <= largest_; ++level) {
		keep(block, level);
		for (int a = 0; a < Dim; ++a) {
			block.lower[a] = floorTo(block.lower[a] - (1 << level), level + 1);
			block.upper[a] = floorTo(block.upper[a] + (1 << level), level + 1);
		}
	}
}

/// A block of a few cells as its cells.
template <int Dim> void Refinement<Dim>::keep(const Block& block, int level)
{
	constexpr double mostCells = 1 << 2 * Dim;
	const Index<Dim> size = ((block.upper.template cast<double>() - block.lower.template cast<double>()) / (1 << level)).template cast<int>().array() + 1;
	if (size.template cast<double>().prod() > mostCells) return blocks_[level].push_back(block);
	for (int i = 0; i < size.prod(); ++i) {
		Index<Dim> cell = block.lower;
		for (int a = 0, rest = i; a < Dim; rest /= size[a], ++a)
			cell[a] += rest % size[a] * (1 << level);
		cells_[level].push_back(Grid<Dim>::key(cell));
	}
}

/// The cells that touch the box are looked up where they are fewer than those that are kept.
template <int Dim> bool Refinement<Dim>::overlapsCells(const Vec<Dim>& low, const Vec<Dim>& high, int level) const
{
	const double   size  = 1 << level;
	const Vec<Dim> first = (low / size).array().ceil() - 1, count = (high / size).array().floor() - first.array() + 1;
	if (!(count.prod() < double(cells_[level].size())))
		return std::any_of(cells_[level].begin(), cells_[level].end(), [&](Key key) {
			const Vec<Dim> cell = Grid<Dim>::index(key).template cast<double>();
			return (high.array() >= cell.array()).all() && (low.array() <= cell.array() + size).all();
		});
	for (int i = 0; i < int(count.prod()); ++i) {
		Index<Dim> cell;
		for (int a = 0, rest = i; a < Dim; rest /= int(count[a]), ++a)
			cell[a] = (int(first[a]) + rest % int(count[a])) * (1 << level);
		if (find(cells_[level], Grid<Dim>::key(cell)) >= 0) return true;
	}
	return false;
}

template <int Dim> int Refinement<Dim>::levelIn(const Vec<Dim>& low, const Vec<Dim>& high) const
{
	const auto overlapsHalved = [&](int level) {
		for (const Block& block : blocks_[level]) {
			bool overlaps = true;
			for (int a = 0; a < Dim; ++a)
				overlaps = overlaps && high[a] >= block.lower[a] && low[a] <= block.upper[a] + (1 << level);
			if (overlaps) return true;
		}
		return overlapsCells(low, high, level);
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
