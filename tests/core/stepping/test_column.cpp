// SPDX-License-Identifier: GPL-2.0-or-later
// The column of Coombs (2023), section 4.1: stress errors known from independent implementations, and what must not
// change them.
#include "scenes.hpp"

namespace gimpm {
namespace {

	constexpr int steps = 40;

	/// Runs the column and returns the error of eq. (7), or NaN if a step failed.
	template <int Dim> double finalError(Column<Dim>& column, int loadSteps = steps)
	{
		const auto original = column.cloud.position;
		for (int i = 1; i <= loadSteps; ++i) {
			const auto report = column.step(i, loadSteps);
			EXPECT_TRUE(report.converged()) << "step " << i << ": " << report.cause;
			EXPECT_LE(report.iterations + 1, 5) << "step " << i;
			if (!report.converged()) return std::nan("");
		}
		return column.error(original);
	}

	double error(int cells, GhostSettings ghost)
	{
		Column<2> column(cells, ghost);
		return finalError(column);
	}

	constexpr GhostSettings none { 0 }, paper { 1e-2, GhostScaling::paper }, consistent { 1e-2, GhostScaling::meshIndependent };

	TEST(Column, ErrorWithoutGhostStabilisation)
	{
		EXPECT_NEAR(error(8, none) / 1.29408206e-2, 1, 1e-6);
		EXPECT_NEAR(error(16, none) / 3.65890602e-3, 1, 1e-6);
		EXPECT_NEAR(error(32, none) / 1.04870581e-3, 1, 1e-6);
	}

	TEST(Column, ErrorWithTheScalingOfThePaper)
	{
		EXPECT_NEAR(error(8, paper) / 9.64276631e-3, 1, 1e-6);
		EXPECT_NEAR(error(16, paper) / 3.01201409e-3, 1, 1e-6);
		EXPECT_NEAR(error(32, paper) / 9.86432725e-4, 1, 1e-6);
	}

	TEST(Column, ErrorWithMeshIndependentScaling)
	{
		EXPECT_NEAR(error(8, consistent) / 1.12729015e-2, 1, 1e-6);
		EXPECT_NEAR(error(16, consistent) / 3.35234265e-3, 1, 1e-6);
		EXPECT_NEAR(error(32, consistent) / 1.01301122e-3, 1, 1e-6);
	}

	TEST(Column, In3DItIsThatOfPlaneStrain)
	{
		for (const auto& ghost : { none, paper, consistent }) {
			Column<2>    flat(8, ghost);
			Column<3>    solid(8, ghost);
			const double expected = finalError(flat);
			EXPECT_NEAR(finalError(solid) / expected, 1, 1e-8);
			// points of the column's front layer, in the same order
			for (std::size_t p = 0; p < flat.cloud.size(); ++p) {
				EXPECT_NEAR(solid.cloud.position[p][1], flat.cloud.position[p][1], 1e-8);
				EXPECT_NEAR(solid.cloud.stress[p].c[1], flat.cloud.stress[p].c[1], 1e-8 * 4e4);
				EXPECT_NEAR(solid.cloud.position[p][0], flat.cloud.position[p][0], 1e-8);
			}
		}
	}

	TEST(Column, SettlesToTheExactHeight)
	{
		// Dead weight s = b l0 / E: log(lambda) / lambda = -s (1 - Y) has the solution lambda = W(x) / x with x
		// = s (1 - Y); its integral is (W + W^2/2) / s at s = 4. The centre of the topmost points lies their
		// half length below the top.
		double W = 1;
		for (int i = 0; i < 50; ++i)
			W -= (W * std::exp(W) - 4) / ((W + 1) * std::exp(W));
		const double exact = 50 / 4. * (W + W * W / 2);
		Column<2>    column(32, consistent);
		finalError(column);
		double top = 0;
		for (std::size_t p = 0; p < column.cloud.size(); ++p)
			top = std::max(top, column.cloud.position[p][1] + column.cloud.halfSize[p][1]);
		EXPECT_NEAR(exact, 24.0596, 1e-4);
		EXPECT_NEAR(top / exact, 1, 2e-3);
	}

	TEST(Column, OneStepAndManyAgreeForSmallLoads)
	{
		// Differences are of the order of the strain, 4e-6. Without ghost forces, which act on increments.
		Column<2>  once(8, none), often(8, none);
		const auto original = once.cloud.position;
		const int  n        = 1000000;
		ASSERT_TRUE(once.step(1, n).converged());
		for (int i = 1; i <= 8; ++i)
			ASSERT_TRUE(often.step(i, 8 * n).converged());
		for (std::size_t p = 0; p < original.size(); ++p) {
			const double settlement = original[p][1] - once.cloud.position[p][1];
			EXPECT_GT(settlement, 0);
			EXPECT_NEAR((original[p][1] - often.cloud.position[p][1]) / settlement, 1, 1e-5);
			EXPECT_NEAR(often.cloud.stress[p].c[1], once.cloud.stress[p].c[1], 1e-5 * 4e4 / n);
		}
	}

	TEST(Column, UnitsOfLengthAndStressDoNotMatter)
	{
		const double expected = error(8, consistent);
		for (const double length : { 1e-9, 1e9 })
			for (const double pressure : { 1e-9, 1e9 }) {
				Column<2> flat(8, consistent, length, pressure);
				EXPECT_NEAR(finalError(flat) / expected, 1, 1e-9) << length << " " << pressure;
				Column<3> solid(8, consistent, length, pressure);
				EXPECT_NEAR(finalError(solid) / expected, 1, 1e-8) << length << " " << pressure;
			}
	}

	TEST(Column, TinyLoadsAreAsPreciseAsLargeOnes)
	{
		// far below the precision of 1 + strain: stress and displacement per load must be those of a linear
		// analysis
		const auto perLoad = [](double load, std::vector<double>& strain) {
			Column<2>  column(8, consistent);
			const auto original = column.cloud.position;
			Load<2>    l;
			l.gravity         = { 0, -10 * load };
			const auto report = loadStep(column.cloud, column.model, l, column.solver);
			EXPECT_TRUE(report.converged()) << report.cause;
			std::vector<double> stress;
			for (std::size_t p = 0; p < column.cloud.size(); ++p) {
				stress.push_back(column.cloud.stress[p].c[1] / load);
				strain.push_back(column.cloud.elasticStrain[p].c[1] / load);
			}
			return stress;
		};
		std::vector<double> linear, strain;
		const auto          expected = perLoad(1e-11, linear);
		for (const double load : { 1e-14, 1e-20, 1e-100 }) {
			strain.clear();
			const auto stress = perLoad(load, strain);
			for (std::size_t p = 0; p < stress.size(); ++p) {
				EXPECT_NEAR(stress[p] / expected[p], 1, 1e-9) << load;
				EXPECT_NEAR(strain[p] / linear[p], 1, 1e-9) << load;
			}
		}
	}

} // namespace
} // namespace gimpm
