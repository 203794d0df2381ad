// SPDX-License-Identifier: GPL-2.0-or-later
// Condition number of the reduced stiffness of a block that moves through the grid (Coombs 2023, figure 2).
#include "scenes.hpp"

namespace gimpm {
namespace {

	/// 2 x 1 cells with 8 points, moved by a into the next cell, on rollers; the base node at x = 2h is held. E =
	/// 1, nu = 0, h = 1.
	double condition(double a, double ghostFactor, Basis basis = Basis::gimp)
	{
		Model<2> model;
		model.basis     = basis;
		model.materials = { { Hencky(1, 0), 1 } };
		model.ghost     = { ghostFactor };
		model.boundary  = Boundary<2>({ wallBelow<2>(model.grid, 1, 0), held<2>(model.grid, { 2, 0 }, { 2, 0 }, "x") });
		auto cloud      = block<2>(model.grid, { 2, 1 }, 2);
		for (auto& x : cloud.position)
			x[0] += a;
		return conditionNumber(tangentStiffness(cloud, model));
	}

	struct Row {
		double a, none, weak, medium, paper, strong; // ghost factors 0, 1e-6, 1e-4, 1e-2, 1
		double digits;
	};

	// Values of independent implementations, with the relative precision to which they were printed.
	const Row rows[] = { { 0, 22.41, 22.41, 22.41, 22.47, 30.77, 2.5e-4 },
		             { 0.1, 8.75e2, 8.75e2, 8.67e2, 4.69e2, 67.6, 1e-3 },
		             { 1e-2, 1.37e5, 1.36e5, 7.27e4, 2.39e3, 91.1, 4e-3 },
		             { 1e-4, 1.45e9, 2.46e7, 2.54e5, 2.59e3, 94.1, 4e-3 } };

	TEST(Condition, OfThePublishedBlock)
	{
		for (const Row& r : rows) {
			EXPECT_NEAR(condition(r.a, 0) / r.none, 1, r.digits) << r.a;
			EXPECT_NEAR(condition(r.a, 1e-6) / r.weak, 1, r.digits) << r.a;
			EXPECT_NEAR(condition(r.a, 1e-4) / r.medium, 1, r.digits) << r.a;
			EXPECT_NEAR(condition(r.a, 1e-2) / r.paper, 1, r.digits) << r.a;
			EXPECT_NEAR(condition(r.a, 1) / r.strong, 1, r.digits) << r.a;
		}
		EXPECT_NEAR(condition(0.01, 0), 137111.4713, 1e-3);
		EXPECT_NEAR(condition(0.01, 1e-2), 2386.516153, 1e-5);
		EXPECT_NEAR(condition(0.1, 0), 874.6780007, 1e-6);
		EXPECT_NEAR(condition(0.1, 1e-2), 469.3251409, 1e-6);
	}

	TEST(Condition, IsBoundedHoweverSmallTheOverlap)
	{
		const double bound = condition(1e-5, 1e-2), unmoved = condition(0, 1e-2);
		for (const double a : { 1e-6, 1e-7, 1e-8 })
			EXPECT_NEAR(condition(a, 1e-2) / bound, 1, 1e-3) << a;
		for (double a = 1e-9; a > 1e-16; a /= 10)
			EXPECT_NEAR(condition(a, 1e-2) / unmoved, 1, 1e-6) << a << ": too small an overlap to count";
	}

	TEST(Condition, OfTheLinearBasisIsThatOfTheUnmovedBlockUntilPointsCross)
	{
		EXPECT_NEAR(condition(0, 0, Basis::linear), 22.41145203, 1e-7);
		EXPECT_NEAR(condition(0.01, 0, Basis::linear), 22.03761841, 1e-7);
	}

	TEST(Condition, IsIndependentOfTheCellSizeWithMeshIndependentScaling)
	{
		const auto scaled = [](double h, GhostScaling scaling) {
			Model<2> model;
			model.grid.cellSize = h;
			model.materials     = { { Hencky(1e6, 0), 1 } };
			model.ghost         = { 1e-2, scaling };
			model.boundary      = Boundary<2>({ wallBelow<2>(model.grid, 1, 0), held<2>(model.grid, { 2 * h, 0 }, { 2 * h, 0 }, "x") });
			auto cloud          = block<2>(model.grid, { 2, 1 }, 2);
			for (auto& x : cloud.position)
				x[0] += 1e-4 * h;
			return conditionNumber(tangentStiffness(cloud, model));
		};
		const double expected = scaled(1, GhostScaling::meshIndependent);
		EXPECT_DOUBLE_EQ(scaled(1, GhostScaling::paper), expected);
		for (const double h : { 1e-3, 1e3 })
			EXPECT_NEAR(scaled(h, GhostScaling::meshIndependent) / expected, 1, 1e-6);
		EXPECT_GT(scaled(1e-3, GhostScaling::paper), 1e3 * expected) << "h^3 fades on fine grids";
	}

	/// A block of 3 x 12 cells on a rough floor, moved to the right and upwards by a; stiff above a soft layer.
	LinearProblem columnOnSoftSoil(double a, double ghostFactor, double contrast)
	{
		Model<2> model;
		model.materials = { { Hencky(1, 0.3), 1 }, { Hencky(contrast, 0.3), 1 } };
		model.ghost     = { ghostFactor };
		model.boundary  = Boundary<2>({ held<2>(model.grid, { -infinity, -infinity }, { infinity, 0 }, "xy") });
		auto cloud      = block<2>(model.grid, { 3, 12 }, 2);
		for (std::size_t p = 0; p < cloud.size(); ++p) {
			cloud.material[p] = cloud.position[p][1] > 4;
			cloud.position[p] += Vec<2>(a, a);
		}
		return tangentStiffness(cloud, model);
	}

	TEST(ConditionEstimate, IsWithinAFactorOfThree)
	{
		for (const double a : { 0., 0.2, 1e-3, 1e-5 })
			for (const double factor : { 0., 1e-6, 1e-2, 1e2 })
				for (const double contrast : { 1., 1e3, 1e5 }) {
					const auto   K     = columnOnSoftSoil(a, factor, contrast);
					const double exact = conditionNumber(K);
					if (exact > 1e13) continue; // round-off of the eigenvalues
					const double estimate = conditionEstimate(K);
					EXPECT_LT(estimate, 1.01 * exact) << a << " " << factor << " " << contrast;
					EXPECT_GT(estimate, exact / 3) << a << " " << factor << " " << contrast;
				}
	}

	TEST(ConditionEstimate, GoesOnWhereEigenvaluesAreRoundOff)
	{
		// Stiffness of the node at the free corner: gradients fall as a^3, so the stiffness as a^6.
		const double kappa = conditionEstimate(columnOnSoftSoil(1e-6, 0, 1));
		EXPECT_GT(kappa, 1e30);
		EXPECT_NEAR(conditionEstimate(columnOnSoftSoil(1e-7, 0, 1)) / kappa, 1e6, 1e4);
	}

	TEST(ConditionEstimate, OfMatricesThatAreNotDefinite)
	{
		const auto matrix = [](double a, double b, double c) { return SymmetricCsc { { { 0, 2, 3 }, { 0, 1, 1 }, { a, b, c } } }; };
		EXPECT_NEAR(conditionEstimate(matrix(1, 2, 1)), 3, 1e-12); // eigenvalues 3 and -1: LU
		EXPECT_EQ(conditionEstimate(matrix(1, 1, 1)), infinity);
	}

} // namespace
} // namespace gimpm
