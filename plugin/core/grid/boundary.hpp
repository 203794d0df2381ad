// SPDX-License-Identifier: GPL-2.0-or-later
// Essential boundary conditions: boxes of grid nodes constrained in some directions, and the walls they form.
#pragma once
#include "core/grid/grid.hpp"
#include <array>
#include <vector>

namespace gimpm {

/// All nodes with lower <= index <= upper are held in the directions of `fixed`.
template <int Dim> struct ConstrainedBox {
	Index<Dim>            lower, upper;
	std::array<bool, Dim> fixed {};
	Vec<Dim>              displacement = Vec<Dim>::Zero();   ///< prescribed total at load factor 1 [m]
	Index<Dim>            period       = Index<Dim>::Zero(); ///< period of the grid; limits along it are between 0 and period, which is node 0 again
	int                   layer        = -1;                 ///< body of the nodes (Grid::layer); -1: all bodies
	bool                  hasHistory   = false;              ///< they move by a history in time (Load::boxMotion)

	/// True if its nodes may move, by `displacement` or a history.
	bool moves() const { return hasHistory || !displacement.isZero(0); }

	/// The nodes of a box in space; a coordinate on a node within Grid::onLine() holds it. Infinite limits are
	/// admitted.
	/// Along a periodic axis the box is that between the two sides, both included.
	static ConstrainedBox from(const Grid<Dim>& grid, const Vec<Dim>& min, const Vec<Dim>& max);

	/// The nodes on the axis of symmetry, along x.
	static ConstrainedBox ofAxis(const Grid<Dim>&);

	bool empty() const { return (lower.array() > upper.array()).any(); }

	/// True if a coordinate of a node, or of one of its images, lies in the box.
	bool covers(int node, int axis) const
	{
		if (period[axis] == 0) return lower[axis] <= node && node <= upper[axis];
		const int position = ((node % period[axis]) + period[axis]) % period[axis];
		return (lower[axis] <= position && position <= upper[axis]) || (position == 0 && upper[axis] == period[axis]);
	}
	bool contains(const Index<Dim>& node) const
	{
		for (int a = 0; a < Dim; ++a)
			if (!covers(node[a], a)) return false;
		return true;
	}
	bool isOf(int other) const { return layer < 0 || layer == other; }
	bool contains(Key node) const { return isOf(Grid<Dim>::layer(node)) && contains(Grid<Dim>::index(node)); }
	bool constrains(const Index<Dim>& node, int axis) const { return fixed[axis] && contains(node); }
	bool constrains(Key node, int axis) const { return fixed[axis] && contains(node); }

	/// True if a node may lie in both boxes.
	bool meets(const ConstrainedBox& other) const;
};

template <int Dim> class Boundary {
public:
	/// `open`: boxes that hold nothing, and still let no point reach through them.
	explicit Boundary(std::vector<ConstrainedBox<Dim>> boxes = {}, std::vector<ConstrainedBox<Dim>> open = {})
	        : boxes_(std::move(boxes)), open_(std::move(open))
	{
	}

	/// The box that holds the node in this direction (the last one given, where several do), or null.
	const ConstrainedBox<Dim>* constrainingBox(const Index<Dim>& node, int axis, int layer = 0) const;
	const ConstrainedBox<Dim>* constrainingBox(Key node, int axis) const { return constrainingBox(Grid<Dim>::index(node), axis, Grid<Dim>::layer(node)); }

	const std::vector<ConstrainedBox<Dim>>& boxes() const { return boxes_; }
	const std::vector<ConstrainedBox<Dim>>& open() const { return open_; }

	/// The open box that the node is in, the last one given, or null.
	const ConstrainedBox<Dim>* opening(const Index<Dim>& node) const;

	/// True if all nodes of the lower face of this cell in this direction are constrained in the face's normal
	/// direction, or in open boxes; not of a face that moves with soil on both sides, or a cell of its box on one.
	bool lowerFaceIsWall(const Index<Dim>& cell, int axis, int level = 0, int layer = 0) const;

	/// Cells that a box which moves holds nodes of, among these.
	std::vector<Key> besideMoving(const std::vector<Key>& cells) const;

	/// Soil on both sides of a face that moves goes along with it, and its domains reach through. `filled`: cells
	/// beside moving boxes with centres of points in them.
	void setFilled(std::vector<Key> filled) { filled_ = std::move(filled); }

private:
	bool goesAlong(const Index<Dim>& cell, int axis, int level, int layer) const;

	std::vector<ConstrainedBox<Dim>> boxes_, open_;
	std::vector<Key>                 filled_; // sorted
};

} // namespace gimpm
