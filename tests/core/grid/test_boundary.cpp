// SPDX-License-Identifier: GPL-2.0-or-later
// Boxes of held nodes, and the cell faces that they turn into walls.
#include "scenes.hpp"

namespace gimpm {
namespace {

	const Grid<2> tenths { 0.1, { 0, 0 } };

	TEST(ConstrainedBox, HoldsNodesOnItsLimitsInSpiteOfRoundOff)
	{
		const auto box = held<2>(tenths, { 0.3, -infinity }, { 3 * 0.1, infinity }, "x"); // 3 * 0.1 > 0.3
		EXPECT_EQ(box.lower[0], 3);
		EXPECT_EQ(box.upper[0], 3);
		const auto shifted = held<2>({ 0.1, { 0.2, 0 } }, { 0.3 + 1e-12, 0 }, { 0.5 - 1e-12, 0 }, "x");
		EXPECT_EQ(shifted.lower[0], 1);
		EXPECT_EQ(shifted.upper[0], 3);
	}

	/// A coordinate of a map, in which round-off is more than 1e-9 cells.
	TEST(ConstrainedBox, HoldsNodesFarAway)
	{
		for (const double place : { 5412000.1, 5412000.2, 5412000.3, 5412345.7 }) {
			const auto box = held<2>(tenths, { place, 0 }, { place, 1 }, "x");
			EXPECT_EQ(box.lower[0], std::lround(10 * place)) << place;
			EXPECT_EQ(box.upper[0], std::lround(10 * place)) << place;
			const Grid<2> corner { 0.1, { place, 0 } };
			const auto    side = held<2>(corner, { place + 2.4, 0 }, { infinity, 1 }, "x");
			EXPECT_EQ(side.lower[0], 24) << place;
			EXPECT_TRUE((held<2>(corner, { place + 0.001, 0 }, { place + 0.099, 1 }, "x").empty())) << place;
		}
	}

	TEST(ConstrainedBox, HoldsNoNodeBetweenNodes)
	{
		EXPECT_TRUE((held<2>(tenths, { 0.31, 0 }, { 0.39, 1 }, "x").empty()));
		EXPECT_FALSE((held<2>(tenths, { 0.31, 0 }, { 0.4, 1 }, "x").empty()));
		EXPECT_TRUE((held<2>(tenths, { 0.3 + 1e-9, 0 }, { 0.4 - 1e-9, 1 }, "x").empty())) << "beyond the tolerance of 1e-9 h";
	}

	TEST(ConstrainedBox, InfiniteLimitsHoldEverythingOnTheGrid)
	{
		const auto box   = held<2>(tenths, { -infinity, -infinity }, { 0, infinity }, "y");
		const int  limit = Grid<2>::indexLimit;
		for (const int y : { -limit - 2, -1, 0, limit + 2 }) {
			EXPECT_TRUE(box.constrains({ 0, y }, 1));
			EXPECT_TRUE(box.constrains({ -limit, y }, 1));
			EXPECT_FALSE(box.constrains({ 1, y }, 1));
			EXPECT_FALSE(box.constrains({ 0, y }, 0)) << "not fixed in x";
		}
	}

	TEST(Boundary, TheLastBoxGivenHoldsTheNode)
	{
		const Boundary<2> boundary({ held<2>(tenths, { 0, 0 }, { 1, 1 }, "xy", { 1, 1 }), held<2>(tenths, { 1, 0 }, { 1, 1 }, "x", { 2, 2 }) });
		EXPECT_EQ(boundary.constrainingBox({ 5, 5 }, 0)->displacement[0], 1);
		EXPECT_EQ(boundary.constrainingBox({ 10, 5 }, 0)->displacement[0], 2);
		EXPECT_EQ(boundary.constrainingBox({ 10, 5 }, 1)->displacement[1], 1);
		EXPECT_EQ(boundary.constrainingBox({ 11, 5 }, 0), nullptr);
	}

	TEST(Boundary, AFaceIsAWallWhenAllItsNodesAreHeldAlongItsNormal)
	{
		// nodes (0, 0) ... (0, 3) held in x, (0, 3) ... (2, 3) in y
		const Boundary<2> boundary({ held<2>(tenths, { 0, 0 }, { 0, 0.3 }, "x"), held<2>(tenths, { 0, 0.3 }, { 0.2, 0.3 }, "y") });
		for (int y = -2; y <= 5; ++y) {
			EXPECT_EQ(boundary.lowerFaceIsWall({ 0, y }, 0), 0 <= y && y < 3) << y;
			EXPECT_FALSE(boundary.lowerFaceIsWall({ 1, y }, 0));
			EXPECT_FALSE(boundary.lowerFaceIsWall({ 0, y }, 1) && y != 3);
		}
		EXPECT_TRUE(boundary.lowerFaceIsWall({ 0, 3 }, 1));
		EXPECT_TRUE(boundary.lowerFaceIsWall({ 1, 3 }, 1));
		EXPECT_FALSE(boundary.lowerFaceIsWall({ 2, 3 }, 1));
		EXPECT_FALSE(boundary.lowerFaceIsWall({ -1, 3 }, 1));
	}

	TEST(Boundary, SeveralBoxesFormAWallTogether)
	{
		const Boundary<2> boundary({ held<2>(tenths, { 0, 0 }, { 0, 0 }, "x"), held<2>(tenths, { 0, 0.1 }, { 0, 0.1 }, "xy") });
		EXPECT_TRUE(boundary.lowerFaceIsWall({ 0, 0 }, 0));
	}

	TEST(Boundary, AWallIn3DNeedsItsFourNodes)
	{
		const Grid<3> grid;
		Boundary<3>   three({ held<3>(grid, { 0, 0, 2 }, { 1, 0, 2 }, "z"), held<3>(grid, { 0, 1, 2 }, { 0, 1, 2 }, "z") });
		EXPECT_FALSE(three.lowerFaceIsWall({ 0, 0, 2 }, 2));
		Boundary<3> four({ held<3>(grid, { 0, 0, 2 }, { 1, 1, 2 }, "z") });
		EXPECT_TRUE(four.lowerFaceIsWall({ 0, 0, 2 }, 2));
		EXPECT_FALSE(four.lowerFaceIsWall({ 0, 0, 2 }, 0));
		EXPECT_FALSE(four.lowerFaceIsWall({ 0, 0, 1 }, 2));
		EXPECT_FALSE(four.lowerFaceIsWall({ 1, 0, 2 }, 2));
	}

} // namespace
} // namespace gimpm
