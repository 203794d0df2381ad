// SPDX-License-Identifier: GPL-2.0-or-later
// Scenes on grids with cells of several sizes, for tests.
#pragma once
#include "scenes.hpp"

namespace gimpm {

/// Largest cells of 1, of which those that a box overlaps are halved so many times; `origin` is a node.
template <int Dim> Grid<Dim> refinedGrid(const std::vector<RefinedBox<Dim>>& boxes, const Vec<Dim>& origin = Vec<Dim>::Zero())
{
	Grid<Dim> grid { 1, origin };
	grid.refinement = std::make_shared<Refinement<Dim>>(boxes, grid);
	grid.cellSize /= 1 << grid.refinement->largest();
	return grid;
}

/// Calls f(leaf) for the leaves of a block of so many largest cells from node 0 on.
template <int Dim, class F> void forLeaves(const Grid<Dim>& grid, const Index<Dim>& size, F&& f)
{
	const int        cells = 1 << grid.refinement->largest();
	std::vector<Key> leaves;
	forIndices<Dim>(Index<Dim>::Zero(), size * cells, [&](const Index<Dim>& i) { leaves.push_back(grid.refinement->leafOf(Grid<Dim>::key(i))); });
	std::sort(leaves.begin(), leaves.end());
	leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
	for (const Key leaf : leaves)
		f(leaf);
}

/// perAxis^Dim points in each leaf of the block.
template <int Dim> PointCloud<Dim> refinedBlock(const Grid<Dim>& grid, const Index<Dim>& size, int perAxis)
{
	PointCloud<Dim> cloud;
	forLeaves<Dim>(grid, size, [&](Key leaf) {
		const double   spacing = grid.size(Grid<Dim>::level(leaf)) / perAxis;
		const Vec<Dim> corner  = grid.nodePosition(Grid<Dim>::index(leaf));
		forIndices<Dim>(Index<Dim>::Zero(), Index<Dim>::Constant(perAxis), [&](const Index<Dim>& i) {
			addPoint<Dim>(cloud, corner + spacing * (i.template cast<double>() + Vec<Dim>::Constant(0.5)), Vec<Dim>::Constant(spacing / 2));
		});
	});
	return cloud;
}

/// Cells of three sizes in a block of 4 x 3 (x 3) largest cells: those near one corner are halved twice.
template <int Dim> Grid<Dim>  cornerGrid() { return refinedGrid<Dim>({ { Vec<Dim>::Constant(0.1), Vec<Dim>::Constant(0.6), 2 } }); }
template <int Dim> Index<Dim> cornerSize() { return cellsOf<Dim>(4, 3, 3); }

/// Prescribes displacement(position) at the nodes on the surface of a block of largest cells that are tied to no
/// others.
template <int Dim, class Displacement>
std::vector<ConstrainedBox<Dim>> prescribedLeaves(const Grid<Dim>& grid, const Index<Dim>& size, Displacement&& displacement)
{
	std::vector<ConstrainedBox<Dim>> boxes;
	for (const auto& box : prescribedSurface<Dim>(grid, size * (1 << grid.refinement->largest()), displacement)) {
		const int level = grid.refinement->largestAt(box.lower);
		if (box.lower == box.lower.unaryExpr([&](int i) { return floorTo(i, level); })) boxes.push_back(box);
	}
	return boxes;
}

/// Points anywhere in that block, of any size up to half of the largest cells.
template <int Dim> PointCloud<Dim> scattered(int points, unsigned seed = 3)
{
	Random          random(seed);
	PointCloud<Dim> cloud;
	for (int i = 0; i < points; ++i) {
		const Vec<Dim> size = cornerSize<Dim>().template cast<double>();
		const Vec<Dim> x    = Vec<Dim>::NullaryExpr([&](Eigen::Index a) { return random.in(0, size[a]); });
		addPoint<Dim>(cloud, x, Vec<Dim>::NullaryExpr([&]() { return random.in(0.01, 0.5); }));
	}
	return cloud;
}

} // namespace gimpm
