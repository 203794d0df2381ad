// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/least_squares.hpp"
#include <gtest/gtest.h>

namespace gimpm {
namespace {

	TEST(LeastSquares, AStraightLineThroughPointsBesideIt)
	{
		Eigen::MatrixXd A(4, 2);
		A << 1, 0, 1, 1, 1, 2, 1, 3;
		const Eigen::VectorXd x = leastSquares(A, Eigen::Vector4d(1, 0, 2, 5));
		EXPECT_NEAR(x[0], -.1, 1e-14); // from the normal equations 4 a + 6 b = 8, 6 a + 14 b = 19
		EXPECT_NEAR(x[1], 1.4, 1e-14);
	}

	TEST(LeastSquares, OfManySolutionsTheShortest)
	{
		Eigen::MatrixXd A(2, 3);
		A << 1, 1, 0, 2, 2, 0;
		const Eigen::VectorXd x = leastSquares(A, Eigen::Vector2d(1, 2));
		EXPECT_NEAR((x - Eigen::Vector3d(.5, .5, 0)).norm(), 0, 1e-14);
	}

	TEST(LeastSquares, OfTheUnitMatrixThePseudoinverse)
	{
		const Eigen::MatrixXd A = Eigen::Vector3d(2, 0, 4).asDiagonal();
		EXPECT_NEAR((leastSquares(A, Eigen::Matrix3d::Identity()) - Eigen::MatrixXd(Eigen::Vector3d(.5, 0, .25).asDiagonal())).norm(), 0, 1e-15);
	}

} // namespace
} // namespace gimpm
