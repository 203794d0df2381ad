// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/boundary.hpp"
#include <algorithm>

namespace gimpm {

template <int Dim> ConstrainedBox<Dim> ConstrainedBox<Dim>::from(const Grid<Dim>& grid, const Vec<Dim>& min, const Vec<Dim>& max)
{
	constexpr double limit = Grid<Dim>::endOfKeys;
	ConstrainedBox   box;
	for (int a = 0; a < Dim; ++a) {
		const double low = (min[a] - grid.origin[a]) / grid.cellSize, high = (max[a] - grid.origin[a]) / grid.cellSize;
		box.lower[a] = int(std::clamp(std::ceil(low - grid.onLine(min[a], a)), -limit, limit));
		box.upper[a] = int(std::clamp(std::floor(high + grid.onLine(max[a], a)), -limit, limit));
		if (grid.period[a] == 0) continue;
		box.lower[a] = std::max(box.lower[a], 0);
		box.upper[a] = std::min(box.upper[a], grid.period[a]);
	}
	box.period = grid.period;
	return box;
}

template <int Dim> ConstrainedBox<Dim> ConstrainedBox<Dim>::ofAxis(const Grid<Dim>& grid)
{
	ConstrainedBox box;
	box.upper.setConstant(Grid<Dim>::endOfKeys);
	box.lower    = -box.upper;
	box.lower[0] = box.upper[0] = grid.axisNode();
	box.fixed[0]                = true;
	for (int a = 1; a < Dim; ++a)
		if (grid.period[a] != 0) box.lower[a] = 0, box.upper[a] = grid.period[a];
	box.period = grid.period;
	return box;
}

template <int Dim> bool ConstrainedBox<Dim>::meets(const ConstrainedBox& other) const
{
	if (!isOf(other.layer) && !other.isOf(layer)) return false;
	for (int a = 0; a < Dim; ++a) {
		const int low = std::max(lower[a], other.lower[a]);
		if (low <= std::min(upper[a], other.upper[a]) || (period[a] != 0 && covers(0, a) && other.covers(0, a))) continue;
		return false;
	}
	return true;
}

template <int Dim> const ConstrainedBox<Dim>* Boundary<Dim>::constrainingBox(const Index<Dim>& node, int axis, int layer) const
{
	for (auto b = boxes_.rbegin(); b != boxes_.rend(); ++b)
		if (b->constrains(node, axis) && b->isOf(layer)) return &*b;
	return nullptr;
}

template <int Dim> const ConstrainedBox<Dim>* Boundary<Dim>::opening(const Index<Dim>& node) const
{
	const auto found = std::find_if(open_.rbegin(), open_.rend(), [&](const ConstrainedBox<Dim>& b) { return b.contains(node); });
	return found == open_.rend() ? nullptr : &*found;
}

template <int Dim> bool Boundary<Dim>::lowerFaceIsWall(const Index<Dim>& cell, int axis, int level, int layer) const
{
	const auto covers         = [&](const ConstrainedBox<Dim>& b) { return b.covers(cell[axis], axis); };
	const bool planeIsTouched = std::any_of(boxes_.begin(), boxes_.end(), [&](const ConstrainedBox<Dim>& b) { return b.fixed[axis] && covers(b); })
	        || std::any_of(open_.begin(), open_.end(), covers);
	if (!planeIsTouched) return false;
	for (int corner = 0; corner < 1 << Dim; ++corner) {
		if (corner >> axis & 1) continue;
		Index<Dim> node = cell;
		for (int a = 0; a < Dim; ++a)
			node[a] += (corner >> a & 1) << level;
		if (!constrainingBox(node, axis, layer) && !opening(node)) return false;
	}
	return filled_.empty() || !goesAlong(cell, axis, level, layer);
}

template <int Dim> std::vector<Key> Boundary<Dim>::besideMoving(const std::vector<Key>& cells) const
{
	std::vector<Key> beside;
	for (const Key cell : cells)
		for (int corner = 0; corner < 1 << Dim; ++corner) {
			Index<Dim> node = Grid<Dim>::index(cell);
			for (int a = 0; a < Dim; ++a)
				node[a] += (corner >> a & 1) << Grid<Dim>::level(cell);
			const auto holds = [&](const ConstrainedBox<Dim>& b) { return b.moves() && b.isOf(Grid<Dim>::layer(cell)) && b.contains(node); };
			if (std::none_of(boxes_.begin(), boxes_.end(), holds)) continue;
			beside.push_back(cell);
			break;
		}
	return beside;
}

/// True with soil on both sides, or with all nodes of a cell on one side in the box that moves.
template <int Dim> bool Boundary<Dim>::goesAlong(const Index<Dim>& cell, int axis, int level, int layer) const
{
	Index<Dim> below = cell, above = cell + Index<Dim>::Constant(1 << level), upper = above;
	below[axis] -= 1 << level, upper[axis] = cell[axis];
	const auto isAround = [&](const ConstrainedBox<Dim>& b) {
		return b.moves() && b.fixed[axis] && b.isOf(layer) && b.contains(cell) && b.contains(upper) && (b.contains(below) || b.contains(above));
	};
	if (std::any_of(boxes_.begin(), boxes_.end(), isAround)) return true;
	return find(filled_, Grid<Dim>::key(cell, level, layer)) >= 0 && find(filled_, Grid<Dim>::key(below, level, layer)) >= 0;
}

template struct ConstrainedBox<2>;
template struct ConstrainedBox<3>;
template class Boundary<2>;
template class Boundary<3>;

} // namespace gimpm
