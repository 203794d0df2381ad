// SPDX-License-Identifier: GPL-2.0-or-later
// Update of the points by a load step: all of it or nothing.
#include "scenes.hpp"
#include <Eigen/LU>
#include <cstring>
#include <omp.h>

namespace gimpm {
namespace {

	/// A block of 3 cells a side that stands on a rough floor, of a soft elastic material.
	template <int Dim> struct Standing {
		Model<Dim>      model;
		PointCloud<Dim> cloud = block<Dim>(model.grid, Index<Dim>::Constant(3), 2);
		Load<Dim>       load;
		LinearSolver    solver;

		explicit Standing(const Law& law = Hencky(1.5e5, 0.3))
		{
			model.materials = { { law, 1e3 } };
			model.boundary  = Boundary<Dim>({ floor() });
			load.gravity    = -10 * Vec<Dim>::Unit(1);
		}
		ConstrainedBox<Dim> floor() const
		{
			Vec<Dim> max = Vec<Dim>::Constant(infinity);
			max[1]       = 0;
			return held<Dim>(model.grid, Vec<Dim>::Constant(-infinity), max, Dim == 2 ? "xy" : "xyz");
		}
		/// Prescribes a displacement of the top.
		void press(double displacement)
		{
			Vec<Dim> min = Vec<Dim>::Constant(-infinity);
			min[1]       = 3;
			model.boundary
			        = Boundary<Dim>({ floor(), held<Dim>(model.grid, min, Vec<Dim>::Constant(infinity), "y", displacement * Vec<Dim>::Unit(1)) });
		}
		StepReport step(double factor = 1, double increment = 1)
		{
			load.factor.value  = factor;
			load.factor.growth = increment;
			return loadStep(cloud, model, load, solver);
		}
	};

	template <class Tensor> bool sameBits(const std::vector<Tensor>& a, const std::vector<Tensor>& b)
	{
		return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Tensor)) == 0);
	}

	template <int Dim> void expectSameBits(const PointCloud<Dim>& a, const PointCloud<Dim>& b)
	{
		EXPECT_TRUE(sameBits(a.position, b.position));
		EXPECT_TRUE(sameBits(a.halfSize, b.halfSize));
		EXPECT_TRUE(sameBits(a.halfSize0, b.halfSize0));
		EXPECT_TRUE(sameBits(a.volume0, b.volume0));
		EXPECT_TRUE(sameBits(a.defGrad, b.defGrad));
		EXPECT_TRUE(sameBits(a.elasticStrain, b.elasticStrain));
		EXPECT_TRUE(sameBits(a.stress, b.stress));
		EXPECT_TRUE(sameBits(plasticStrains(a), plasticStrains(b)));
		EXPECT_TRUE(sameBits(a.material, b.material));
		EXPECT_TRUE(sameBits(a.force, b.force));
	}

	template <class Dimension> using LoadStep = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(LoadStep, BothDimensions, DimensionName);

	TYPED_TEST(LoadStep, ThatFailsLeavesThePointsBitForBit)
	{
		constexpr int Dim             = TypeParam::value;
		const auto    expectUnchanged = [](Failure expected, auto&& spoil) {
                        Standing<Dim> scene(VonMises(1e6, 0.3, 2e4));
                        ASSERT_TRUE(scene.step(0.5).converged());
                        const auto before = scene.cloud;
                        spoil(scene);
                        EXPECT_EQ(scene.step().failure, expected);
                        expectSameBits(scene.cloud, before);
		};
		expectUnchanged(Failure::tooManyIterations, [](auto& scene) { scene.model.newton.maxIterations = 1; });
		expectUnchanged(Failure::inverted, [](auto& scene) { scene.press(-4); });
		expectUnchanged(Failure::notFinite, [](auto& scene) { scene.load.gravity[0] = std::nan(""); });
		expectUnchanged(Failure::unrestrained, [](auto& scene) { scene.model.boundary = Boundary<Dim>(); });
	}

	TYPED_TEST(LoadStep, ARepeatedStepGivesTheSameBits)
	{
		constexpr int Dim = TypeParam::value;
		Standing<Dim> once, again;
		ASSERT_TRUE(once.step().converged());
		again.model.newton.maxIterations = 1;
		EXPECT_FALSE(again.step().converged());
		again.model.newton.maxIterations = 20;
		ASSERT_TRUE(again.step().converged());
		expectSameBits(once.cloud, again.cloud);
	}

	TYPED_TEST(LoadStep, AnyNumberOfThreadsGivesTheSameBits)
	{
		constexpr int   Dim    = TypeParam::value;
		const int       before = omp_get_max_threads();
		PointCloud<Dim> expected;
		for (int threads = 1; threads <= 3; ++threads) {
			omp_set_num_threads(threads);
			Standing<Dim> scene(VonMises(1e6, 0.3, 1e4));
			for (int i = 1; i <= 3; ++i)
				ASSERT_TRUE(scene.step(i / 3.).converged());
			if (threads == 1) expected = scene.cloud;
			expectSameBits(scene.cloud, expected);
		}
		omp_set_num_threads(before);
	}

	TYPED_TEST(LoadStep, WithoutLoadIsConvergedAtOnce)
	{
		Standing<TypeParam::value> scene;
		const auto                 before = scene.cloud;
		const auto                 report = scene.step(0, 0);
		EXPECT_TRUE(report.converged());
		EXPECT_EQ(report.residuals, std::vector<double> { 0 });
		EXPECT_EQ(report.iterations, 0);
		for (std::size_t p = 0; p < before.size(); ++p) {
			EXPECT_TRUE(scene.cloud.position[p] == before.position[p]);
			EXPECT_TRUE(scene.cloud.stress[p].c.isZero(0));
		}
	}

	TYPED_TEST(LoadStep, AtConstantLoadMovesNothing)
	{
		Standing<TypeParam::value> scene;
		// Hardly deformed, so that the new basis functions are the old ones.
		ASSERT_TRUE(scene.step(1e-4).converged());
		const auto before = scene.cloud;
		for (int i = 0; i < 5; ++i) {
			const auto report = scene.step(1e-4, 0);
			ASSERT_TRUE(report.converged()) << report.cause;
			EXPECT_LE(report.iterations, 1);
		}
		for (std::size_t p = 0; p < before.size(); ++p)
			EXPECT_LT((scene.cloud.position[p] - before.position[p]).norm(), 1e-7);
	}

	TYPED_TEST(LoadStep, ReportsSizes)
	{
		constexpr int Dim = TypeParam::value;
		Standing<Dim> scene;
		const auto    report = scene.step();
		const int     nodes = Dim == 2 ? 16 : 64, floor = Dim == 2 ? 4 : 16;
		EXPECT_EQ(report.nodes, nodes);
		EXPECT_EQ(report.dofs, Dim * (nodes - floor));
		EXPECT_EQ(report.populatedCells, Dim == 2 ? 9 : 27);
		// All but the one in the middle and the one below it.
		EXPECT_EQ(report.boundaryCells, Dim == 2 ? 7 : 25);
		EXPECT_EQ(report.ghostFaces, Dim == 2 ? 11 : 53);
		EXPECT_EQ(report.luSolves, 0);
		EXPECT_EQ(report.cause, "");
	}

	TYPED_TEST(LoadStep, DomainsFollowTheDeformationUpToHalfACell)
	{
		constexpr int Dim = TypeParam::value;
		Standing<Dim> scene;
		const auto    size0 = scene.cloud.halfSize0;
		scene.load.gravity *= -2; // pulled up: domains of a quarter of a cell grow
		scene.cloud.halfSize[0] = scene.cloud.halfSize0[0] = Vec<Dim>::Constant(0.5);
		const auto report                                  = scene.step();
		ASSERT_TRUE(report.converged()) << report.cause;
		EXPECT_EQ(report.clampedDomains, 1);
		EXPECT_EQ(scene.cloud.halfSize[0][1], 0.5);
		for (std::size_t p = 1; p < scene.cloud.size(); ++p) {
			const Vec<Dim> tiling = domainOf<Dim>(scene.cloud.defGrad[p], size0[p], DomainRule::tiling);
			EXPECT_LT((scene.cloud.halfSize[p] - tiling.cwiseMin(0.5)).norm(), 1e-15);
			EXPECT_GT(scene.cloud.halfSize[p][1], size0[p][1]);
		}
	}

	TYPED_TEST(LoadStep, CauchyStressIsKirchhoffStressOverTheWholeChangeOfVolume)
	{
		Standing<TypeParam::value> scene;
		for (int i = 1; i <= 3; ++i)
			ASSERT_TRUE(scene.step(i / 3.).converged());
		for (std::size_t p = 0; p < scene.cloud.size(); ++p) {
			const double G = 1.5e5 / 2.6, lambda = G * 0.6 / 0.4;
			const Mat3   e = scene.cloud.elasticStrain[p].full(), tau = 2 * G * e + lambda * e.trace() * Mat3::Identity();
			const double J = std::exp(e.trace()); // all strain is elastic
			EXPECT_NEAR(scene.cloud.defGrad[p].determinant(), J, 1e-12);
			EXPECT_LT((scene.cloud.stress[p].full() - tau / J).norm(), 1e-10 * tau.norm());
		}
	}

	TYPED_TEST(LoadStep, PointLoadsActLikeWeight)
	{
		constexpr int Dim = TypeParam::value;
		Standing<Dim> weight, forces;
		for (const double v : forces.cloud.volume0)
			forces.cloud.force.push_back(1e3 * v * forces.load.gravity);
		forces.load.gravity.setZero();
		ASSERT_TRUE(weight.step().converged());
		ASSERT_TRUE(forces.step().converged());
		for (std::size_t p = 0; p < weight.cloud.size(); ++p)
			EXPECT_LT((weight.cloud.position[p] - forces.cloud.position[p]).norm(), 1e-12);
	}

} // namespace
} // namespace gimpm
