// SPDX-License-Identifier: GPL-2.0-or-later
// The surface of a body of points in one step: contact points that move with the linear functions of the grid.
#pragma once
#include "core/grid/attachment.hpp"
#include "core/grid/surface.hpp"

namespace gimpm {

/// Pieces of a surface; they are cut where they cross the lines or planes of the grid, so that what acts on them evenly
/// acts on the nodes as an even stress does. Vertices of the surface come first, in its order.
template <int Dim> struct Facets {
	using Piece     = typename Surface<Dim>::Piece;
	using Positions = std::vector<Vec<Dim>>;

	Positions                                   start; ///< positions of the vertices [m]
	std::vector<std::optional<Attachment<Dim>>> at;    ///< none: there is no material near
	std::vector<Piece>                          pieces;
	std::vector<int>                            whole; ///< piece of the surface that each piece is part of

	/// Facets of the body whose nodes are in a layer, or, if not empty, in that of each piece of the surface where
	/// that is not less than 0.
	Facets(const Surface<Dim>&, const CloudBasis<Dim>&, const Grid<Dim>&, int layer, const std::vector<int>& layerOfPiece = {});

	bool      isThere(const Piece&) const; ///< all of its vertices
	Positions positionsAt(const Eigen::VectorXd& d) const;
};

/// Attaches one contact point after another of a body like attach(), and farther away to the position in the nearest
/// populated cell of its neighbours: what soil leaves behind of its surface goes with it. Those inside of the cell that
/// the last one was inside of need not look for its nodes.
template <int Dim> class Attacher {
public:
	/// The basis and the grid must outlive it.
	Attacher(const CloudBasis<Dim>& basis, const Grid<Dim>& grid, int layer) : basis_(basis), grid_(grid), layer_(layer) { }
	std::optional<Attachment<Dim>> operator()(const Vec<Dim>& position);
	/// Takes those of another layer from now on.
	void goTo(int layer)
	{
		if (layer != layer_) layer_ = layer, last_.reset();
	}

private:
	const CloudBasis<Dim>&         basis_;
	const Grid<Dim>&               grid_;
	int                            layer_;
	std::optional<Attachment<Dim>> last_; // inside of its cell
};

} // namespace gimpm
