// SPDX-License-Identifier: GPL-2.0-or-later
// Sides of lines and closest points on them.
#include "core/structures/from_line.hpp"
#include <gtest/gtest.h>

namespace gimpm::testFromLine {
namespace {

	TEST(FromLine, TellsTheClosestPointAndTheSide)
	{
		const std::vector<Vec<2>> line { { 0, 0 }, { 2, 0 }, { 2, 2 } };
		const FromLine            left = fromLine(line, { 0.5, 1 }), right = fromLine(line, { 0.5, -1 });
		EXPECT_EQ(left.foot, Vec<2>(0.5, 0));
		EXPECT_EQ(left.normal, Vec<2>(0, 1));
		EXPECT_EQ(left.left, 1);
		EXPECT_GT(left.side, 0);
		EXPECT_LT(right.side, 0);
		EXPECT_EQ(right.away, 1);
		EXPECT_FALSE(left.isBeyond);
		EXPECT_TRUE(fromLine(line, { -0.1, 1 }).isBeyond);
		EXPECT_TRUE(fromLine(line, { 1.9, 2.1 }).isBeyond);
	}

	/// Nearest to the corner, and on the wrong side of the straight line through one of the pieces.
	TEST(FromLine, IsOnOneSideBeyondASharpCorner)
	{
		const std::vector<Vec<2>> line { { 0, 0 }, { 2, 0 }, { 0, 0.5 } };
		for (const Vec<2>& position : { Vec<2>(2.5, 0.1), Vec<2>(2.5, -0.1) })
			EXPECT_LT(fromLine(line, position).side, 0) << position.transpose();
	}

	TEST(FromLine, HasNoEndsWhereItIsClosed)
	{
		const std::vector<Vec<2>> ring { { 0, 0 }, { 2, 0 }, { 2, 2 }, { 0, 0 } };
		EXPECT_FALSE(fromLine(ring, { -0.1, -0.1 }).isBeyond);
		EXPECT_LT(fromLine(ring, { -0.1, -0.1 }).side, 0);
		EXPECT_GT(fromLine(ring, { 1.5, 0.5 }).side, 0);
	}

} // namespace
} // namespace gimpm::testFromLine
