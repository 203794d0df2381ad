// SPDX-License-Identifier: GPL-2.0-or-later
// A surface of segments in the plane, of triangles in space.
#pragma once
#include "core/grid/grid.hpp"
#include <array>
#include <cmath>

namespace gimpm {

/// Length of a segment times the normal on its right; area of a triangle times the normal on the side from which its
/// corners run counterclockwise.
Vec<2> pieceNormal(const Vec<2>& a, const Vec<2>& b);
Vec<3> pieceNormal(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c);

/// Parts of the length of a segment at which it crosses lines of the grid, rising; nothing is cut off that is shorter
/// than a millionth of a cell, or of the segment.
std::vector<double> linesCrossed(const Vec<2>& a, const Vec<2>& b, const Grid<2>& grid);

/// Circumference of the ring on which a position lies, or one metre where there is no axis of symmetry.
template <int Dim> double aroundAxis(double radius, const Grid<Dim>& grid) { return grid.axisymmetric ? 2 * M_PI * radius : 1; }

/// Length of the sides of a surface's pieces where they act on the grid, in cells. Nodes are then given their shares of
/// a uniform load to a per cent or better (exactly where segments fit into the cells); the error falls with the square
/// of the length.
constexpr double pieceLimit = 0.25;

/// The body is on the left of a segment, from its first to its second vertex; of a triangle on the side from which its
/// vertices run clockwise.
template <int Dim> struct Surface {
	using Piece = std::array<int, Dim>;

	std::vector<Vec<Dim>> vertices;  ///< [m]
	std::vector<Vec<Dim>> vertices0; ///< initial vertices [m]
	std::vector<Piece>    pieces;

	/// Outward normal of a piece; `x` are the positions of all vertices.
	Vec<Dim> normal(const Piece&, const std::vector<Vec<Dim>>& x) const;

	/// True if the surface has no edge: every vertex in the plane and every side of a triangle belongs to two
	/// pieces.
	bool isClosed() const;

	/// True if a piece, or any of them, cuts the way from a to b.
	bool cuts(const Piece&, const Vec<Dim>& a, const Vec<Dim>& b) const;
	bool isBetween(const Vec<Dim>& a, const Vec<Dim>& b) const;

	/// Divides the sides that are longer than `limit`, until none is left. Returns for each piece the number of
	/// that which it is part of.
	std::vector<int> refine(double limit);
};

/// Divides the rectangles that two triangles make up into equal ones with sides up to `size`, each of four triangles
/// around its centre: so it does not matter along which diagonal they were divided. For a surface that has not moved.
void divideRectangles(Surface<3>&, double size);

} // namespace gimpm
