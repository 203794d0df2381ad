// SPDX-License-Identifier: GPL-2.0-or-later
// Load steps whose end has neither external forces nor reactions, which a residual relative to those cannot judge.
#include "scenes.hpp"

namespace gimpm {
namespace {

	template <class Dimension> using Unloading = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(Unloading, BothDimensions, DimensionName);

	template <int Dim> double largestStress(const PointCloud<Dim>& cloud)
	{
		double largest = 0;
		for (const auto& s : cloud.stress)
			largest = std::max(largest, s.full().norm());
		return largest;
	}

	template <int Dim> double largestDistance(const std::vector<Vec<Dim>>& a, const std::vector<Vec<Dim>>& b)
	{
		double largest = 0;
		for (std::size_t p = 0; p < a.size(); ++p)
			largest = std::max(largest, (a[p] - b[p]).norm());
		return largest;
	}

	TYPED_TEST(Unloading, ToZeroAndStayingThere)
	{
		constexpr int Dim = TypeParam::value;
		for (const double peak : { 0.2, 1e-6 }) {
			Column<Dim> column(8);
			const auto  start = column.cloud.position;
			Load<Dim>   load;
			load.gravity   = -10 * Vec<Dim>::Unit(1);
			double highest = 0, settlement = 0;
			for (const double factor : { 0.25, 0.5, 0.75, 1., 0.75, 0.5, 0.25, 0., 0., 0., 0., 0., 0. }) {
				load.factor.value = factor * peak;
				const auto report = loadStep(column.cloud, column.model, load, column.solver);
				ASSERT_TRUE(report.converged()) << factor << ": " << report.cause;
				highest    = std::max(highest, largestStress(column.cloud));
				settlement = std::max(settlement, largestDistance<Dim>(column.cloud.position, start));
			}
			EXPECT_LT(largestStress(column.cloud), peak * highest) << "stresses that balance each other within a cell";
			EXPECT_LT(largestDistance<Dim>(column.cloud.position, start), 0.01 * settlement);
		}
	}

	TYPED_TEST(Unloading, APrestressedBlockLetGo)
	{
		// Only rollers below and what fixes the place: no node is held against the stress, which does not reach
		// the reactions.
		constexpr int   Dim = TypeParam::value;
		Model<Dim>      model;
		PointCloud<Dim> cloud  = block<Dim>(model.grid, Index<Dim>::Constant(4), 2);
		Vec<Dim>        middle = 2 * Vec<Dim>::Ones(), side = middle;
		middle[1] = side[1] = 0, side[0] = 3;
		model.materials = { { Hencky(1e6, 0.3), 1 } };
		std::vector<ConstrainedBox<Dim>> boxes { wallBelow<Dim>(model.grid, 1, 0), held<Dim>(model.grid, middle, middle, Dim == 2 ? "x" : "xz") };
		if (Dim == 3) boxes.push_back(held<Dim>(model.grid, side, side, "z"));
		model.boundary         = Boundary<Dim>(boxes);
		model.newton.tolerance = 1e-10;
		for (auto& e : cloud.elasticStrain)
			e = SymTensor<Dim>::from(Mat3(Vec3(0.01, 0, 0).asDiagonal()));
		const auto   start = cloud.position;
		LinearSolver solver;
		for (int i = 0; i < 5; ++i) {
			const auto report = loadStep(cloud, model, {}, solver);
			ASSERT_TRUE(report.converged()) << report.cause;
		}
		// strained by 0.01 along x; let go, it takes its stress-free shape
		EXPECT_LT(largestStress(cloud), 1e-8 * 1e4);
		EXPECT_NEAR((cloud.position.back()[0] - cloud.position.front()[0]) / (start.back()[0] - start.front()[0]), std::exp(-0.01), 1e-10);
	}

} // namespace
} // namespace gimpm
