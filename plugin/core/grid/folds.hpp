// SPDX-License-Identifier: GPL-2.0-or-later
// Nodes that are there twice, because a body of points has folded and its surface is near itself.
#pragma once
#include "core/grid/point_cloud.hpp"
#include "core/grid/surface.hpp"

namespace gimpm {

/// A body that may fold, as a step begins.
template <int Dim> struct FoldingBody {
	int                 layer;       ///< layer of its nodes away from folds
	const Surface<Dim>* surface;     ///< encloses its points
	std::vector<double> pressure {}; ///< on its pieces, if they have contact points; those keep them

	/// In this step: layers of its pieces that face others within some cells, -1 of the others; empty: there are
	/// none.
	std::vector<int> layerOfPiece {};
};

/// Gives points on all sides of folds but one layers of their own, and the grid the nodes there that are there twice.
///
/// The points that have functions of a node are in parts if no chain of neighbours connects them without a way through
/// the surface; then each part has a node of its own. So the tip of a fold is where its sides are connected within two
/// cells. Parts that share points are one side; sides that meet at a node have different layers. Folds with more sides
/// than there are bits stick. `bitsOfBodies`: bits of the layers of bodies.
template <int Dim> void partFolds(std::vector<FoldingBody<Dim>>&, int bitsOfBodies, PointCloud<Dim>&, Grid<Dim>&);

} // namespace gimpm
