// SPDX-License-Identifier: GPL-2.0-or-later
// Rectangles of a surface, divided without regard to their diagonals.
#include "core/grid/surface.hpp"
#include <algorithm>
#include <gtest/gtest.h>

namespace gimpm::testSurfaceRectangles {
namespace {

	/// A rectangle of two triangles, along the one or the other diagonal.
	Surface<3> rectangle(double length, double width, bool isOther)
	{
		Surface<3> surface;
		surface.vertices = surface.vertices0 = { { 0, 0, 0 }, { length, 0, 0 }, { length, width, 0 }, { 0, width, 0 } };
		surface.pieces
		        = isOther ? std::vector<Surface<3>::Piece> { { 0, 1, 3 }, { 1, 2, 3 } } : std::vector<Surface<3>::Piece> { { 0, 1, 2 }, { 2, 3, 0 } };
		return surface;
	}

	/// Centroids of the pieces with their areas, in one order.
	std::vector<std::array<double, 3>> parts(const Surface<3>& surface)
	{
		std::vector<std::array<double, 3>> all;
		for (const auto& piece : surface.pieces) {
			const Vec<3> centre = (surface.vertices[piece[0]] + surface.vertices[piece[1]] + surface.vertices[piece[2]]) / 3;
			const Vec<3> normal = surface.normal(piece, surface.vertices);
			EXPECT_GT(normal[2], 0);
			all.push_back({ std::round(1e6 * centre[0]), std::round(1e6 * centre[1]), std::round(1e6 * normal.norm()) });
		}
		std::sort(all.begin(), all.end());
		return all;
	}

	TEST(SurfaceRectanglesTest, TheDiagonalDoesNotMatter)
	{
		for (const double length : { 0.9, 1., 2.5 }) {
			auto one = rectangle(length, 1.5, false), other = rectangle(length, 1.5, true);
			divideRectangles(one, 1), divideRectangles(other, 1);
			EXPECT_EQ(one.pieces.size(), 8 * std::ceil(length));
			EXPECT_EQ(one.vertices.size(), one.vertices0.size());
			EXPECT_EQ(parts(one), parts(other));
			one.refine(0.75), other.refine(0.75);
			EXPECT_EQ(parts(one), parts(other));
		}
	}

	TEST(SurfaceRectanglesTest, OtherTrianglesStay)
	{
		Surface<3> surface;
		surface.vertices = surface.vertices0 = { { 0, 0, 0 }, { 3, 0, 0 }, { 0, 2, 0 }, { 4, 3, 0 } };
		surface.pieces                       = { { 0, 1, 2 }, { 1, 3, 2 } };
		divideRectangles(surface, 1);
		EXPECT_EQ(surface.pieces.size(), 2u);
		EXPECT_EQ(surface.vertices.size(), 4u);
	}

} // namespace
} // namespace gimpm::testSurfaceRectangles
