// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/parts_of_body.hpp"
#include "core/grid/cells_around.hpp"
#include "core/grid/disjoint_sets.hpp"
#include "core/grid/refinement.hpp"
#include <unordered_map>

namespace gimpm {
namespace {

/// A box in a cell.
using InCell = std::pair<Key, int>;

/// Boxes by the cells that they reach into, sorted.
template <int Dim> std::vector<InCell> boxesInCells(const std::vector<DomainBox<Dim>>& boxes, const Vec<Dim>& origin, double size)
{
	std::vector<InCell> found;
	for (int b = 0; b < int(boxes.size()); ++b)
		forCellsOf(boxes[b], origin, size, [&](const Index<Dim>& cell) { found.emplace_back(Grid<Dim>::key(cell), b); });
	std::sort(found.begin(), found.end());
	return found;
}

/// First boxes of cells, in a block of cells with a margin of one; for boxes that fill some of it.
template <int Dim> class Block {
public:
	Block(const std::vector<DomainBox<Dim>>& boxes, const Vec<Dim>& origin, double size)
	{
		if (boxes.empty()) return;
		Vec<Dim> low = boxes[0].low, high = boxes[0].high;
		for (const auto& box : boxes)
			low = low.cwiseMin(box.low), high = high.cwiseMax(box.high);
		const auto cellOf = [&](const Vec<Dim>& x) { return Index<Dim>(((x - origin) / size).array().floor().template cast<int>()); };
		low_ = cellOf(low) - Index<Dim>::Constant(1), count_ = cellOf(high) - low_ + Index<Dim>::Constant(2);
		const double cells = count_.template cast<double>().prod();
		isFilled_          = cells < 1e4 + 64. * double(boxes.size());
		if (isFilled_) first_.assign(std::size_t(cells), -1);
	}
	bool isFilled() const { return isFilled_; }
	int& firstIn(const Index<Dim>& cell) { return first_[number(cell)]; }

	/// Calls f(box, box of a neighbouring cell).
	template <class F> void forNeighbours(F&& f) const
	{
		std::vector<std::ptrdiff_t> ahead;
		for (int n = cellsAround<Dim> / 2 + 1; n < cellsAround<Dim>; ++n)
			ahead.push_back(number(low_ + offsetAround<Dim>(n)));
		for (std::size_t c = 0; c < first_.size(); ++c)
			for (const auto step : ahead)
				if (first_[c] >= 0 && first_[c + step] >= 0) f(first_[c], first_[c + step]);
	}

private:
	std::ptrdiff_t number(const Index<Dim>& cell) const
	{
		std::ptrdiff_t number = 0;
		for (int a = Dim - 1; a >= 0; --a)
			number = number * count_[a] + cell[a] - low_[a];
		return number;
	}

	Index<Dim>       low_ = Index<Dim>::Zero(), count_ = Index<Dim>::Zero();
	bool             isFilled_ = true;
	std::vector<int> first_; // -1: none
};

/// Calls f(cell) for the neighbours of a cell of higher keys, and the cell itself.
template <int Dim, class F> void forCellsAhead(Key cell, F&& f)
{
	for (int n = 0; n < cellsAround<Dim>; ++n)
		if (const Key near = Grid<Dim>::key(Grid<Dim>::index(cell) + offsetAround<Dim>(n)); near >= cell) f(near);
}

/// The parts in a grid of several sizes: of boxes in the same leaf, or in two that touch.
template <int Dim> std::vector<int> partsOnLeaves(const std::vector<DomainBox<Dim>>& boxes, const Grid<Dim>& grid)
{
	const auto                   leafAt = [&](const Index<Dim>& cell) { return grid.refinement->leafOf(Grid<Dim>::key(cell)); };
	DisjointSets                 sets(int(boxes.size()));
	std::unordered_map<Key, int> firstIn;
	for (int b = 0; b < int(boxes.size()); ++b)
		forCellsOf(boxes[b], grid.origin, grid.cellSize, [&](const Index<Dim>& cell) { sets.join(b, firstIn.emplace(leafAt(cell), b).first->second); });
	for (const auto& [leaf, box] : firstIn) {
		const Index<Dim> low = Grid<Dim>::index(leaf).array() - 1, high = low.array() + 1 + (1 << Grid<Dim>::level(leaf));
		forIndicesUpTo<Dim>(low, high, [&, box = box](const Index<Dim>& cell) {
			if ((cell.array() > low.array()).all() && (cell.array() < high.array()).all()) return;
			if (const auto found = firstIn.find(leafAt(cell)); found != firstIn.end()) sets.join(box, found->second);
		});
	}
	return sets.numbers();
}

} // namespace

template <int Dim> std::vector<int> partsBySharedNodes(const std::vector<DomainBox<Dim>>& boxes, const Grid<Dim>& grid)
{
	if (grid.refinement) return partsOnLeaves(boxes, grid);
	const Vec<Dim>& origin   = grid.origin;
	const double    cellSize = grid.cellSize;
	DisjointSets    sets(int(boxes.size()));
	Block<Dim>      block(boxes, origin, cellSize);
	if (block.isFilled()) {
		for (int b = 0; b < int(boxes.size()); ++b)
			forCellsOf(boxes[b], origin, cellSize, [&](const Index<Dim>& cell) {
				int& first = block.firstIn(cell);
				first < 0 ? void(first = b) : sets.join(b, first);
			});
		block.forNeighbours([&](int one, int other) { sets.join(one, other); });
		return sets.numbers();
	}
	std::vector<Key> cells;
	std::vector<int> firstIn; // by cell
	for (const auto& [cell, box] : boxesInCells(boxes, origin, cellSize)) {
		if (cells.empty() || cells.back() != cell) cells.push_back(cell), firstIn.push_back(box);
		sets.join(box, firstIn.back());
	}
	for (std::size_t c = 0; c < cells.size(); ++c)
		forCellsAhead<Dim>(cells[c], [&](Key near) {
			if (const int other = find(cells, near); other >= 0) sets.join(firstIn[c], firstIn[other]);
		});
	return sets.numbers();
}

template <int Dim> std::vector<int> partsByTouch(const std::vector<DomainBox<Dim>>& boxes, double gap, double cellSize)
{
	const auto touch = [&](const DomainBox<Dim>& one, const DomainBox<Dim>& other) {
		return (one.low - other.high).maxCoeff() <= gap && (other.low - one.high).maxCoeff() <= gap;
	};
	std::vector<InCell> centres;
	for (int b = 0; b < int(boxes.size()); ++b)
		centres.emplace_back(Grid<Dim>::key(((boxes[b].low + boxes[b].high) / (2 * cellSize)).array().floor().template cast<int>()), b);
	std::sort(centres.begin(), centres.end());
	DisjointSets sets(int(boxes.size()));
	for (const auto& [cell, box] : centres)
		forCellsAhead<Dim>(cell, [&, box = box](Key near) {
			for (auto i = std::lower_bound(centres.begin(), centres.end(), InCell(near, -1)); i != centres.end() && i->first == near; ++i)
				if (touch(boxes[box], boxes[i->second])) sets.join(box, i->second);
		});
	return sets.numbers();
}

template <int Dim>
std::set<std::pair<int, int>> sharingNodes(const std::vector<DomainBox<Dim>>& boxes, const std::vector<int>& owners, const Vec<Dim>& origin, double cellSize)
{
	std::vector<InCell> cells; // with owners
	for (const auto& [cell, box] : boxesInCells(boxes, origin, cellSize))
		cells.emplace_back(cell, owners[box]);
	std::sort(cells.begin(), cells.end());
	cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
	std::set<std::pair<int, int>> found;
	for (const auto& [cell, owner] : cells)
		forCellsAhead<Dim>(cell, [&, owner = owner](Key near) {
			for (auto i = std::lower_bound(cells.begin(), cells.end(), InCell(near, -1)); i != cells.end() && i->first == near; ++i)
				if (i->second != owner) found.insert(std::minmax(owner, i->second));
		});
	return found;
}

template <int Dim> std::vector<int> nearestBoxes(const std::vector<DomainBox<Dim>>& boxes, const std::vector<Vec<Dim>>& positions, double cellSize)
{
	const auto       inCells = boxesInCells<Dim>(boxes, Vec<Dim>::Zero(), cellSize);
	const auto       away    = [&](int box, const Vec<Dim>& x) { return (boxes[box].low - x).cwiseMax(x - boxes[box].high).cwiseMax(0.).squaredNorm(); };
	std::vector<int> nearest;
	for (const Vec<Dim>& x : positions) {
		int        best  = -1;
		double     least = std::numeric_limits<double>::infinity();
		const auto look  = [&](int box) {
                        if (const double far = away(box, x); far < least) least = far, best = box;
		};
		const Index<Dim> cell = (x / cellSize).array().floor().template cast<int>();
		for (int n = 0; n < cellsAround<Dim>; ++n) {
			const Key near = Grid<Dim>::key(cell + offsetAround<Dim>(n));
			for (auto i = std::lower_bound(inCells.begin(), inCells.end(), InCell(near, -1)); i != inCells.end() && i->first == near; ++i)
				look(i->second);
		}
		for (int box = 0, isFar = best < 0; isFar && box < int(boxes.size()); ++box)
			look(box);
		nearest.push_back(best);
	}
	return nearest;
}

template std::vector<int>              partsBySharedNodes(const std::vector<DomainBox<2>>&, const Grid<2>&);
template std::vector<int>              partsBySharedNodes(const std::vector<DomainBox<3>>&, const Grid<3>&);
template std::vector<int>              partsByTouch(const std::vector<DomainBox<2>>&, double, double);
template std::vector<int>              partsByTouch(const std::vector<DomainBox<3>>&, double, double);
template std::set<std::pair<int, int>> sharingNodes(const std::vector<DomainBox<2>>&, const std::vector<int>&, const Vec<2>&, double);
template std::set<std::pair<int, int>> sharingNodes(const std::vector<DomainBox<3>>&, const std::vector<int>&, const Vec<3>&, double);
template std::vector<int>              nearestBoxes(const std::vector<DomainBox<2>>&, const std::vector<Vec<2>>&, double);
template std::vector<int>              nearestBoxes(const std::vector<DomainBox<3>>&, const std::vector<Vec<3>>&, double);

} // namespace gimpm
