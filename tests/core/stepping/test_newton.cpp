// SPDX-License-Identifier: GPL-2.0-or-later
// Newton's method: quadratic convergence, and what ends it.
#include "bench/scenes.hpp"
#include "scenes.hpp"
#include <cstdio>

namespace gimpm {
namespace {

	void print(const char* name, int dim, const std::vector<double>& residuals)
	{
		std::printf("%s, %dD:", name, dim);
		for (const double r : residuals)
			std::printf(" %.2e", r);
		std::printf(", order %.2f\n", convergenceOrder(residuals, 1e-14));
	}

	/// A block of 3 cells a side on a floor that holds it, free at the other faces.
	template <int Dim> struct Block {
		Model<Dim>      model;
		PointCloud<Dim> cloud = block<Dim>(model.grid, Index<Dim>::Constant(3), 2);
		Load<Dim>       load;
		LinearSolver    solver;

		explicit Block(const Law& law)
		{
			Vec<Dim> max             = Vec<Dim>::Constant(infinity);
			max[1]                   = 0;
			model.materials          = { { law, 1e3 } };
			model.boundary           = Boundary<Dim>({ held<Dim>(model.grid, Vec<Dim>::Constant(-infinity), max, Dim == 2 ? "xy" : "xyz") });
			model.newton.tolerance   = 1e-13;
			model.newton.reuseFactor = false; // it converges linearly
			load.gravity             = -10 * Vec<Dim>::Unit(1);
		}
		StepReport step() { return loadStep(cloud, model, load, solver); }
	};

	template <class Dimension> using Newton = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(Newton, BothDimensions, DimensionName);

	TYPED_TEST(Newton, ConvergesQuadraticallyInFiniteElasticity)
	{
		Block<TypeParam::value> block(Hencky(1.5e5, 0.3)); // settles by about a tenth
		const auto              report = block.step();
		print("elastic block", TypeParam::value, report.residuals);
		ASSERT_TRUE(report.converged()) << report.cause;
		EXPECT_GT(convergenceOrder(report.residuals, 1e-14), 1.8);
		EXPECT_EQ(report.iterations + 1, int(report.residuals.size()));
	}

	TYPED_TEST(Newton, ConvergesQuadraticallyInPlasticity)
	{
		Block<TypeParam::value> block(VonMises(2e6, 0.3, 1e4));
		const auto              report = block.step();
		print("plastic block", TypeParam::value, report.residuals);
		ASSERT_TRUE(report.converged()) << report.cause;
		const auto flow = plasticStrains(block.cloud);
		EXPECT_GT(*std::max_element(flow.begin(), flow.end()), 1e-3);
		EXPECT_GT(convergenceOrder(report.residuals, 1e-14), 1.8);
	}

	TYPED_TEST(Newton, EndsAtTheToleranceAndNotBefore)
	{
		for (const double tolerance : { 1e-3, 1e-6, 1e-10 }) {
			Block<TypeParam::value> block(Hencky(1.5e5, 0.3));
			block.model.newton.tolerance = tolerance;
			const auto report            = block.step();
			ASSERT_TRUE(report.converged());
			EXPECT_LE(report.residual(), tolerance);
			EXPECT_GT(report.residuals[report.residuals.size() - 2], tolerance);
		}
	}

	TYPED_TEST(Newton, ResidualIsRelativeToExternalForcesAndReactions)
	{
		// At the start of the first step nothing is stressed: no reactions, and all of the load on free nodes
		// is out of balance.
		Block<TypeParam::value> block(Hencky(1.5e5, 0.3));
		EXPECT_NEAR(block.step().residuals.front(), 1, 1e-15);
	}

	TYPED_TEST(Newton, GivesUpAfterTheLargestNumberOfIterations)
	{
		Block<TypeParam::value> block(Hencky(1.5e5, 0.3));
		block.model.newton.maxIterations = 2;
		const auto report                = block.step();
		EXPECT_EQ(report.failure, Failure::tooManyIterations);
		EXPECT_EQ(report.iterations, 2);
		EXPECT_NE(report.cause.find("after 2 iterations"), std::string::npos) << report.cause;
		EXPECT_GT(std::abs(report.worst.force), 0);
		EXPECT_GT(report.worst.position[1], 0) << "a node on the floor is held and cannot be out of balance";
	}

	TYPED_TEST(Newton, TakesOverAnUnconvergedIterateOnlyOnRequest)
	{
		Block<TypeParam::value> block(Hencky(1.5e5, 0.3));
		block.model.newton.maxIterations     = 2;
		block.model.newton.acceptUnconverged = true;
		const auto start                     = block.cloud.position;
		const auto report                    = block.step();
		EXPECT_FALSE(report.converged());
		EXPECT_TRUE(report.accepted);
		EXPECT_FALSE(block.cloud.position == start);
	}

	TYPED_TEST(Newton, IsInterruptedWithinOneIteration)
	{
		Block<TypeParam::value> block(Hencky(1.5e5, 0.3));
		int                     asked        = 0;
		block.model.newton.interrupted       = [&]() { return ++asked == 2; };
		block.model.newton.acceptUnconverged = true;
		const auto start                     = block.cloud.position;
		const auto report                    = block.step();
		EXPECT_EQ(report.failure, Failure::interrupted);
		EXPECT_EQ(report.iterations, 1);
		EXPECT_FALSE(report.accepted);
		EXPECT_TRUE(block.cloud.position == start);
	}

	TYPED_TEST(Newton, ConjugateGradientsGiveTheSameState)
	{
		for (const Law& law : { Law(Hencky(1.5e5, 0.3)), Law(VonMises(2e6, 0.3, 1e4)) }) {
			Block<TypeParam::value> direct(law), iterative(law);
			direct.model.newton.linearSolver = LinearMethod::direct, iterative.model.newton.linearSolver = LinearMethod::iterative;
			direct.model.newton.tolerance = iterative.model.newton.tolerance = 1e-10;
			const auto expected = direct.step(), report = iterative.step();
			ASSERT_TRUE(expected.converged() && report.converged()) << report.cause;
			EXPECT_GT(report.conjugateGradients.iterations, report.iterations);
			EXPECT_EQ(report.conjugateGradients.fallbacks, 0);
			EXPECT_LE(report.iterations, expected.iterations + 1) << "inexact solves must hardly add any";
			EXPECT_EQ(expected.conjugateGradients.iterations, 0);
			for (std::size_t p = 0; p < direct.cloud.size(); ++p)
				EXPECT_LT((direct.cloud.position[p] - iterative.cloud.position[p]).norm(), 1e-8) << p;
		}
	}

	TYPED_TEST(Newton, ConjugateGradientsSolveTheColumn)
	{
		// 0: without stabilisation, ill-conditioned wherever a node is hardly touched
		for (const double factor : { 1e-2, 0. }) {
			Column<TypeParam::value> direct(16, { factor }), iterative(16, { factor });
			direct.model.newton.linearSolver = LinearMethod::direct, iterative.model.newton.linearSolver = LinearMethod::iterative;
			int expected = 0, solves = 0;
			for (int i = 1; i <= 10; ++i) {
				const auto a = direct.step(i, 10), b = iterative.step(i, 10);
				ASSERT_TRUE(a.converged() && b.converged()) << i << ": " << a.cause << b.cause;
				expected += a.iterations, solves += b.iterations;
			}
			EXPECT_LE(solves, 1.2 * expected) << factor;
			for (std::size_t p = 0; p < direct.cloud.size(); ++p)
				EXPECT_LT((direct.cloud.position[p] - iterative.cloud.position[p]).norm(), 1e-6 * direct.height) << p;
		}
	}

	TYPED_TEST(Newton, ReusedFactorsGiveTheSameState)
	{
		Block<TypeParam::value> each(VonMises(2e6, 0.3, 1e4)), reusing(VonMises(2e6, 0.3, 1e4));
		reusing.model.newton.reuseFactor = true;
		each.model.newton.tolerance = reusing.model.newton.tolerance = 1e-8;
		const auto expected = each.step(), report = reusing.step();
		ASSERT_TRUE(expected.converged() && report.converged()) << report.cause;
		EXPECT_EQ(expected.reusedFactors, 0);
		EXPECT_GT(report.reusedFactors, 0);
		EXPECT_LT(report.iterations - report.reusedFactors, expected.iterations) << "they must save factorisations";
		EXPECT_LE(report.residual(), 1e-8);
		for (std::size_t p = 0; p < each.cloud.size(); ++p)
			EXPECT_LT((each.cloud.position[p] - reusing.cloud.position[p]).norm(), 1e-7) << p;
	}

	/// Ten load steps from the one at which the factor is first known, and how many factors they take.
	template <int Dim> std::pair<Block<Dim>, int> tenSteps(const Law& law, int keepFactor, int maxIterations = 20)
	{
		std::pair<Block<Dim>, int> found { Block<Dim>(law), 0 };
		Block<Dim>&                b = found.first;
		b.model.newton.tolerance     = 1e-8;
		b.model.newton.keepFactor    = keepFactor;
		b.load.ofGravity             = LoadFactor { 0.5, 0.5 };
		EXPECT_TRUE(b.step().converged());
		b.model.newton.maxIterations = maxIterations;
		for (int i = 0; i < 10; ++i) {
			b.load.ofGravity        = LoadFactor { b.load.ofGravity->value + 0.01, 0.01 };
			const StepReport report = b.step();
			EXPECT_TRUE(report.converged()) << report.cause;
			EXPECT_LE(report.residual(), 1e-8);
			found.second += report.iterations - report.reusedFactors;
		}
		return found;
	}

	TYPED_TEST(Newton, AFactorServesStepsThatChangeLittle)
	{
		constexpr int Dim = TypeParam::value;
		for (const bool isElastic : { true, false }) {
			const Law law               = isElastic ? Law(Hencky(2e7, 0.3)) : Law(VonMises(2e6, 0.3, 1e4));
			const auto [each, factors]  = tenSteps<Dim>(law, 0);
			const auto [keeping, fewer] = tenSteps<Dim>(law, 4);
			for (std::size_t p = 0; p < each.cloud.size(); ++p)
				EXPECT_LT((each.cloud.position[p] - keeping.cloud.position[p]).norm(), 1e-7) << p;
			EXPECT_GE(factors, 10);
			if (isElastic) EXPECT_LE(fewer, 2);
			else
				EXPECT_LE(fewer, factors + 1) << "what changes more goes on with its own";
		}
	}

	TYPED_TEST(Newton, AnEarlierFactorTakesNoSolvesFromThoseAllowed)
	{
		constexpr int Dim = TypeParam::value;
		for (const Law& law : { Law(Hencky(2e6, 0.3)), Law(VonMises(2e6, 0.3, 1e4)) })
			for (const int most : { 3, 4 }) {
				const Block<Dim> each = tenSteps<Dim>(law, 0, most).first, keeping = tenSteps<Dim>(law, 1000000, most).first;
				for (std::size_t p = 0; p < each.cloud.size(); ++p)
					EXPECT_LT((each.cloud.position[p] - keeping.cloud.position[p]).norm(), 1e-7) << p;
			}
	}

	TYPED_TEST(Newton, ALoadBelowTheToleranceIsNotLost)
	{
		Block<TypeParam::value> block(Hencky(1.5e5, 0.3));
		ASSERT_TRUE(block.step().converged());
		const auto before            = block.cloud.position;
		block.model.newton.tolerance = 1e-3;
		block.load.factor.value += 1e-6;
		const auto report = block.step();
		EXPECT_EQ(report.iterations, 1);
		EXPECT_LT(block.cloud.position.back()[1], before.back()[1]);
	}

	TYPED_TEST(Newton, LoadsThatAreNotNumbersEndIt)
	{
		for (const double bad : { std::nan(""), infinity }) {
			Block<TypeParam::value> block(Hencky(1.5e5, 0.3));
			block.load.gravity[0] = bad;
			const auto start      = block.cloud.position;
			EXPECT_EQ(block.step().failure, Failure::notFinite);
			EXPECT_TRUE(block.cloud.position == start);
		}
	}

	/// A cantilever, eight times as long as high, under its own weight at once.
	StepReport bend(double gravity, int lineSearchTrials)
	{
		Model<2> model;
		auto     wall                 = wallBelow<2>(model.grid, 0, 0);
		wall.fixed[1]                 = true;
		model.boundary                = Boundary<2>({ wall });
		model.materials               = { { Hencky(1e6, 0.3), 100 } };
		model.newton.lineSearchTrials = lineSearchTrials;
		PointCloud<2> cloud           = block<2>(model.grid, { 8, 1 }, 2);
		LinearSolver  solver;
		return loadStep(cloud, model, { Vec<2>(0, -gravity) }, solver);
	}

	// The residual rises by up to a factor of sixteen in the first step and falls below its first value within two.
	TEST(Newton, LineSearchDoesNotHinderBending)
	{
		for (const double gravity : { 0.3, 1., 3., 5. }) {
			const auto full = bend(gravity, 0), searched = bend(gravity, 5);
			EXPECT_TRUE(full.converged()) << full.cause;
			EXPECT_GT(full.residuals[1], full.residuals[0]);
			EXPECT_EQ(searched.residuals, full.residuals);
			EXPECT_EQ(searched.lineSearchTrials, 0);
		}
	}

	// The first full step that raises the residual leads nowhere: the way back costs one solve.
	TEST(Newton, LineSearchCarriesTheSlopeThroughItsWholeLoad)
	{
		auto scene        = slope<2>(1, 3);
		scene.steps       = 1;
		const auto report = scene.step();
		EXPECT_TRUE(report.converged()) << report.cause;
		EXPECT_LE(report.iterations, 12);
		EXPECT_GT(report.lineSearchTrials, 0);
	}

} // namespace
} // namespace gimpm
