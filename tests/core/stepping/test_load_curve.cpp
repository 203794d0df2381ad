// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/load_curve.hpp"
#include <gtest/gtest.h>
#include <limits>

namespace gimpm {
namespace {

	constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

	TEST(LoadCurve, isLinearBetweenItsKneesAndConstantOutside)
	{
		const LoadCurve curve({ { 1, 0 }, { 2, 4 }, { 4, 3 } });
		EXPECT_EQ(curve.valueAt(-5), 0);
		EXPECT_EQ(curve.valueAt(1), 0);
		EXPECT_EQ(curve.valueAt(1.25), 1);
		EXPECT_EQ(curve.valueAt(2), 4);
		EXPECT_EQ(curve.valueAt(3), 3.5);
		EXPECT_EQ(curve.valueAt(4), 3);
		EXPECT_EQ(curve.valueAt(100), 3);
		EXPECT_EQ(curve.end(), 4);
	}

	TEST(LoadCurve, growsInAStep)
	{
		const LoadFactor factor = LoadCurve({ { 0, 0 }, { 1, 1 } }).between(.25, .75);
		EXPECT_EQ(factor.value, .75);
		EXPECT_EQ(factor.growth, .5);
		EXPECT_EQ(factor.before(), .25);
	}

	TEST(LoadCurve, mayBeAConstant)
	{
		const LoadFactor factor = LoadCurve({ { 0, 2 } }).between(-1, 1);
		EXPECT_EQ(factor.value, 2);
		EXPECT_EQ(factor.growth, 0);
	}

	TEST(LoadCurve, needsFiniteKneesInOrder)
	{
		EXPECT_TRUE(LoadCurve::isAdmissible({ { 0, 1 } }));
		EXPECT_TRUE(LoadCurve::isAdmissible({ { -1, 1 }, { 0, 0 }, { 7, -3 } }));
		EXPECT_FALSE(LoadCurve::isAdmissible({}));
		EXPECT_FALSE(LoadCurve::isAdmissible({ { 0, 1 }, { 0, 2 } }));
		EXPECT_FALSE(LoadCurve::isAdmissible({ { 1, 1 }, { 0, 2 } }));
		for (const double bad : { inf, -inf, nan }) {
			EXPECT_FALSE(LoadCurve::isAdmissible({ { bad, 1 } }));
			EXPECT_FALSE(LoadCurve::isAdmissible({ { 0, 0 }, { 1, bad } }));
		}
	}

} // namespace
} // namespace gimpm
