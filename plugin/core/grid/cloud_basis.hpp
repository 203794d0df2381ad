// SPDX-License-Identifier: GPL-2.0-or-later
// Step 1 of the method: how the material points and the background grid interact in the configuration at the start of a
// load step.
#pragma once
#include "core/grid/affine_constraints.hpp"
#include "core/grid/basis.hpp"
#include "core/grid/boundary.hpp"
#include "core/grid/point_cloud.hpp"
#include "core/parallel/division.hpp"
#include <array>

namespace gimpm {

/// Nodes and cells around one lowest cell: a domain of at most one cell's width reaches two cells and three nodes per
/// axis.
template <int Dim> constexpr int windowNodes = Dim == 2 ? 9 : 27;
template <int Dim> constexpr int windowCells = Dim == 2 ? 4 : 8;

/// Material points that share their nodes: same lowest cell and level, same number of cells per axis, same walls. A
/// point is of the level of the smallest leaf that its domain touches; what of its window lies in larger leaves are
/// cells of that level too, whose nodes are tied.
template <int Dim> struct Patch {
	Key                               cell;                 ///< lowest cell
	int                               span  = 0;            ///< bit a set: the domains reach two cells along axis a
	int                               cells = 0;            ///< bit c set: cell c of the window (x fastest) is reached, not hidden by a wall
	int                               first = 0, count = 0; ///< its points in CloudBasis::order
	std::array<int, windowNodes<Dim>> node;                 ///< node numbers of the 2 or 3 nodes per axis, x fastest; -1: beyond a wall
	std::array<int, windowCells<Dim>> reached;              ///< numbers of the cells of the window, positions in CloudBasis::cells; -1: not reached

	int nodesAlong(int axis) const { return 2 + (span >> axis & 1); }
};

template <int Dim> struct CloudBasis {
	std::vector<int>             order; ///< points sorted by patch, then by their position in the cloud
	std::vector<PointBasis<Dim>> axes;  ///< basis functions per axis, in that order
	std::vector<AxisValues>      hoop; ///< around an axis of symmetry: of x, over the distance from it [1/m], so that u_x gives the hoop strain; else empty
	std::vector<Patch<Dim>>      patches;           ///< patches by colour, tile and lowest cell
	std::vector<Key>             nodes;             ///< active nodes, sorted; the node number is the position here
	std::vector<Key>             cells;             ///< populated cells, sorted
	AffineConstraints            affineConstraints; ///< among the nodes
	std::vector<Key>             leaves;            ///< leaves with populated cells, sorted; empty in a grid of equal cells, whose cells are the leaves
	std::vector<int>             leafOf;            ///< numbers of the leaves of the cells; empty there too
	/// Tiles are blocks of a few cells: what their points add to on the grid stays in the processor's cache, and
	/// lies in memory as it is read. Ranges of patches [first, last) with the lowest cell in the same tile, by
	/// colour: the tiles of one of the 2^Dim colours are no neighbours, so that no two of its ranges share a node.
	/// Where the grid is periodic there may be 3^Dim.
	std::vector<std::vector<std::pair<int, int>>> colours;
	/// Largest length by which a domain reaches behind a wall [m]; that part is dropped.
	double largestWallOverlap = 0;

	bool isAxisymmetric() const { return !hoop.empty(); }

	const std::vector<Key>& populatedLeaves() const { return leafOf.empty() ? cells : leaves; }
	int                     leaf(int cell) const { return leafOf.empty() ? cell : leafOf[cell]; }
};

/// Positions must be finite and within the grid's index limit, half sizes in (0, h/2] with h of the largest cells;
/// where cells are smaller, a domain reaches no farther than half of them. With a division there are the patches of the
/// points of this process, and the cells and nodes of all.
template <int Dim> CloudBasis<Dim> cloudBasis(const PointCloud<Dim>&, const Grid<Dim>&, Basis, const Boundary<Dim>&, const Division& = {});

} // namespace gimpm
