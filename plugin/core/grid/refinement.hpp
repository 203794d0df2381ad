// SPDX-License-Identifier: GPL-2.0-or-later
// Refinement of a grid: cells are halved, once or more, so that there are several sizes, of which neighbours differ by
// one level at most.
#pragma once
#include "core/grid/basis.hpp"
#include "core/grid/grid.hpp"
#include <array>

namespace gimpm {

/// The coordinate of the cell of a level along one axis, in smallest cells.
inline int floorTo(int i, int level) { return (i >> level) * (1 << level); }

/// A box in space in which cells are halved so many times.
template <int Dim> struct RefinedBox {
	Vec<Dim> min, max; ///< [m]; limits may be infinite
	int      halvings = 1;
};

/// The cells that are not halved are the leaves of a tree; a leaf of level l is 2^l times as large as the smallest
/// cells, those of level 0. All cells that overlap a box are halved. Around them cells are halved as often as it takes
/// for leaves that touch, be it in a corner, to differ by one level at most: around a block of cells these are blocks
/// again, so that of large blocks no cell needs to be stored. Small ones, of which there may be many, are kept as
/// cells.
template <int Dim> class Refinement {
public:
	/// `grid` has the size of the largest cells. There is at least one box, of at least one halving and at most
	/// Grid::mostLevel.
	Refinement(const std::vector<RefinedBox<Dim>>& boxes, const Grid<Dim>& grid);

	int largest() const { return largest_; } ///< level of the cells that are nowhere halved

	/// True if a cell is halved; cells beyond the leaves are not.
	bool isHalved(const Index<Dim>& cell, int level) const
	{
		for (const Block& block : blocks_[level])
			if ((block.lower.array() <= cell.array()).all() && (cell.array() <= block.upper.array()).all()) return true;
		return !cells_[level].empty() && find(cells_[level], Grid<Dim>::key(cell)) >= 0;
	}

	/// The leaf that contains a cell, which may be the cell itself; it must not be halved.
	Key leafOf(Key cell) const
	{
		int level = largest_;
		while (level > 0 && isHalved(ancestor(cell, level), level))
			--level;
		return Grid<Dim>::key(ancestor(cell, level), level, Grid<Dim>::layer(cell));
	}

	/// The lowest level among the leaves that a box in space touches: it is given from the grid's origin on, in
	/// smallest cells.
	int levelIn(const Vec<Dim>& low, const Vec<Dim>& high) const;

	/// Level of the largest of the leaves that touch a node.
	int largestAt(const Index<Dim>& node) const;

	/// Calls f(leaf, level of the common face) for the leaves beyond one face of a leaf.
	template <class F> void forLeavesBeyond(Key leaf, int axis, bool isAbove, F&& f) const
	{
		const int level  = Grid<Dim>::level(leaf);
		const Key beyond = isAbove ? leaf + Grid<Dim>::keyStep(axis, level) : leaf - Grid<Dim>::keyStep(axis, level);
		if (level == 0 || !isHalved(Grid<Dim>::index(beyond), level)) return f(leafOf(beyond), level);
		for (int child = 0; child < 1 << Dim; ++child)
			if ((child >> axis & 1) != isAbove)
				f(Grid<Dim>::key(Grid<Dim>::index(beyond), level - 1, Grid<Dim>::layer(leaf)) + Grid<Dim>::keyOffset(child, level - 1),
				  level - 1);
	}

	/// The cell of this level that contains another.
	static Index<Dim> ancestor(Key cell, int level)
	{
		return Grid<Dim>::index(cell).unaryExpr([level](int i) { return floorTo(i, level); });
	}

private:
	/// Cells of one level: in smallest cells, the lowest nodes of the first and the last.
	struct Block {
		Index<Dim> lower, upper;
	};
	void halve(Block block, int level);
	void keep(const Block& block, int level);
	bool overlapsCells(const Vec<Dim>& low, const Vec<Dim>& high, int level) const;

	int                                                      largest_ = 0;
	std::array<std::vector<Block>, Grid<Dim>::mostLevel + 1> blocks_; // halved blocks by level
	std::array<std::vector<Key>, Grid<Dim>::mostLevel + 1>   cells_;  // other halved cells by level, sorted
};

/// Size of the largest cells [m].
template <int Dim> double largestCell(const Grid<Dim>& grid) { return grid.size(grid.refinement ? grid.refinement->largest() : 0); }

/// Size of the cell that a position lies in, of the smallest of several [m].
template <int Dim> double cellSizeAt(const Grid<Dim>& grid, const Vec<Dim>& position)
{
	if (!grid.refinement) return grid.cellSize;
	const Vec<Dim> x = (position - grid.origin) / grid.cellSize;
	if (!(x.array().abs() < Grid<Dim>::indexLimit).all()) return grid.cellSize; // off the grid
	return grid.size(grid.refinement->levelIn(x, x));
}

/// Half of the cell that a position lies in [m]: domains of points there are no larger.
template <int Dim> double largestHalf(const Grid<Dim>& grid, const Vec<Dim>& position) { return 0.5 * cellSizeAt(grid, position); }

/// Level of the smallest leaf that a domain lies in.
template <int Dim> int levelTouched(const Grid<Dim>& grid, const Vec<Dim>& position, const Vec<Dim>& halfSize)
{
	if (!grid.refinement) return 0;
	const Vec<Dim> x = (position - grid.origin) / grid.cellSize, l = halfSize * (1 - overlapTolerance) / grid.cellSize;
	return grid.refinement->levelIn(x - l, x + l);
}

} // namespace gimpm
