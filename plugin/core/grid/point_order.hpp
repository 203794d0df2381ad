// SPDX-License-Identifier: GPL-2.0-or-later
// Order of points in the grid: the level and the lowest cell of its window, and which cells of that it reaches.
#pragma once
#include "core/grid/cloud_basis.hpp"
#include "core/grid/tile_order.hpp"

namespace gimpm {

template <int Dim> Index<Dim> corner(const Index<Dim>& cell, int bits)
{
	Index<Dim> i = cell;
	for (int a = 0; a < Dim; ++a)
		i[a] += bits >> a & 1;
	return i;
}

/// In its own cells, of a body in a layer.
template <int Dim> bool lowerFaceIsWall(const Boundary<Dim>& boundary, const Index<Dim>& cell, int axis, int level, int layer)
{
	return boundary.lowerFaceIsWall(cell * (1 << level), axis, level, layer);
}

/// The cell that holds the point's centre. On a face it is the lower cell, unless that lies behind the wall of that
/// face.
template <int Dim> Index<Dim> containingCell(const Vec<Dim>& x, double h, const Boundary<Dim>& boundary, int level, int layer)
{
	const auto isWall = [&](const Index<Dim>& cell, int axis) { return lowerFaceIsWall(boundary, cell, axis, level, layer); };
	Index<Dim> cell;
	for (int a = 0; a < Dim; ++a)
		cell[a] = centreCell(x[a], h);
	for (int a = 0; a < Dim; ++a) {
		const Index<Dim> upper = cell + Index<Dim>::Unit(a), beyond = upper + Index<Dim>::Unit(a);
		const bool       onUpperFace = std::abs(x[a] / h - upper[a]) <= faceTolerance;
		if (onUpperFace && isWall(upper, a) && isWall(cell, a) && !isWall(beyond, a)) cell = upper;
	}
	return cell;
}

/// The cells of a window that can be reached from the cell of the centre through faces which are no walls.
template <int Dim> int reachableCells(const Index<Dim>& lowest, int span, int centre, const Boundary<Dim>& boundary, int level, int layer)
{
	int reached = 1 << centre;
	for (int before = 0; before != reached;) {
		before = reached;
		for (int c = 0; c < 1 << Dim; ++c) {
			if (!(reached >> c & 1)) continue;
			for (int a = 0; a < Dim; ++a) {
				const int neighbour = c ^ 1 << a;
				if (!(span >> a & 1) || (reached >> neighbour & 1)) continue;
				if (!lowerFaceIsWall(boundary, corner<Dim>(lowest, c | 1 << a), a, level, layer)) reached |= 1 << neighbour;
			}
		}
	}
	return reached;
}

/// Data that the points are sorted by. It is kept small: the basis functions are computed once the order is known.
template <int Dim> struct PointOrder {
	Key      order; // order of the lowest cell
	unsigned kind;  // span and cells
	int      point;

	PointOrder() { } // all are set
	PointOrder(Key cell, int span, int cells, int point)
	        : order(TileOrder<Dim>::of(cell)), kind(unsigned(span) << (1 << Dim) | unsigned(cells)), point(point)
	{
	}
	int  span() const { return int(kind >> (1 << Dim)); }
	int  cells() const { return int(kind & ((1 << (1 << Dim)) - 1)); }
	bool samePatch(const PointOrder& o) const { return order == o.order && kind == o.kind; }
	// Without branches, which could only guess here.
	bool operator<(const PointOrder& o) const { return whole() < o.whole(); }

private:
	unsigned __int128 whole() const { return (unsigned __int128)order << 64 | Key(kind) << 32 | unsigned(point); }
};

/// Length of the domain behind walls along its own axis: the part on the other side of a face than the centre.
template <int Dim> double hiddenLength(const PointOrder<Dim>& p, const Vec<Dim>& x, const Vec<Dim>& halfSize, double h, const Index<Dim>& lowest, int centre)
{
	double length = 0;
	for (int a = 0; a < Dim; ++a)
		if ((p.span() >> a & 1) && !(p.cells() >> (centre ^ 1 << a) & 1)) length = std::max(length, halfSize[a] - std::abs(x[a] - h * (lowest[a] + 1)));
	return length;
}

/// The level of the smallest leaf that a point touches.
template <int Dim> int levelOf(const PointCloud<Dim>& cloud, int point, const Grid<Dim>& grid, Basis basis)
{
	if (basis == Basis::gimp || !grid.refinement) return levelTouched(grid, cloud.position[point], cloud.halfSize[point]);
	return levelTouched<Dim>(grid, cloud.position[point], Vec<Dim>::Constant(faceTolerance * grid.size(grid.refinement->largest())));
}

/// Half lengths of the domain in cells of a level.
template <int Dim> Vec<Dim> domainIn(const PointCloud<Dim>& cloud, int point, const Grid<Dim>& grid, int level)
{
	return grid.refinement ? Vec<Dim>(cloud.halfSize[point].cwiseMin(grid.size(level) / 2)) : cloud.halfSize[point];
}

template <int Dim>
PointOrder<Dim> pointOrder(const PointCloud<Dim>& cloud, int point, const Grid<Dim>& grid, Basis basis, const Boundary<Dim>& boundary, double& hidden)
{
	const int        level = levelOf(cloud, point, grid, basis), layer = cloud.layerOf(point);
	const double     h = grid.size(level);
	const Vec<Dim>   x = cloud.position[point] - grid.origin, halfSize = domainIn(cloud, point, grid, level);
	const Index<Dim> centre = containingCell<Dim>(x, h, boundary, level, layer);
	Index<Dim>       lowest = centre;
	int              span = 0, centreBits = 0; // span of the window; bits of its cell that holds the centre
	for (int a = 0; basis == Basis::gimp && a < Dim; ++a) {
		const auto cells = AxisCells::reached(x[a], halfSize[a], h);
		lowest[a]        = cells.lowest;
		if (cells.count == 1) continue;
		span |= 1 << a;
		if (centre[a] > lowest[a]) centreBits |= 1 << a;
	}
	const Key             cell = Grid<Dim>::key(grid.first(lowest * (1 << level)), level, layer);
	const PointOrder<Dim> p(cell, span, reachableCells<Dim>(lowest, span, centreBits, boundary, level, layer), point);
	hidden = std::max(hidden, hiddenLength<Dim>(p, x, halfSize, h, lowest, centreBits));
	return p;
}

} // namespace gimpm
