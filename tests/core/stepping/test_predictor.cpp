// SPDX-License-Identifier: GPL-2.0-or-later
#include "bench/scenes.hpp"
#include "core/stepping/predictor.hpp"
#include "scenes.hpp"

namespace gimpm {
namespace {

	std::vector<Key> row(int first, int last)
	{
		std::vector<Key> nodes;
		for (int i = first; i <= last; ++i)
			nodes.push_back(Grid<2>::key({ i, 0 }));
		return nodes;
	}

	TEST(Predictor, ScalesWithTheLoadAndKnowsNothingAfterAReversal)
	{
		const LastIncrement<2> last { row(0, 2), Eigen::VectorXd::LinSpaced(6, 1, 6), 0.5 };
		EXPECT_EQ(predict(last, row(0, 2), 0.25), Eigen::VectorXd(last.displacement / 2));
		EXPECT_EQ(predict(last, row(1, 2), 0.5), Eigen::VectorXd(last.displacement.tail<4>()));
		EXPECT_EQ(predict(last, row(0, 2), -0.5).size(), 0);
		EXPECT_EQ(predict(last, row(0, 2), 0).size(), 0);
		EXPECT_EQ(predict(LastIncrement<2>(), row(0, 2), 1).size(), 0);
	}

	TEST(Predictor, NewNodesFollowTheirNeighbours)
	{
		const LastIncrement<2> last { row(0, 0), Eigen::Vector2d(3, 4), 1 };
		EXPECT_EQ(predict(last, row(-2, 2), 1), Eigen::VectorXd(Eigen::Vector2d(3, 4).replicate<5, 1>()));
		std::vector<Key> withIsland = row(0, 0);
		withIsland.push_back(Grid<2>::key({ 7, 0 }));
		EXPECT_EQ(predict(last, withIsland, 1), Eigen::VectorXd(Eigen::Vector4d(3, 4, 0, 0)));
	}

	/// The slope of the paper, loaded in so many steps with and without prediction.
	struct Runs {
		BenchScene<2> zero, predicted;
		int           solves[2] = { 0, 0 }, starts = 0;

		explicit Runs(int steps) : zero(slope<2>(1, 2)), predicted(slope<2>(1, 2))
		{
			LastIncrement<2> last;
			for (int i = 1; i <= steps; ++i) {
				const Load<2> load { zero.gravity, { double(i) / steps, 1. / steps } };
				const auto    a = loadStep(zero.cloud, zero.model, load, zero.solver);
				const auto    b = loadStep(predicted.cloud, predicted.model, load, predicted.solver, &last);
				EXPECT_TRUE(a.converged()) << a.cause;
				EXPECT_TRUE(b.converged()) << b.cause;
				solves[0] += a.iterations, solves[1] += b.iterations, starts += b.predicted;
			}
		}
		double difference() const
		{
			double largest = 0;
			for (std::size_t p = 0; p < zero.cloud.size(); ++p)
				largest = std::max(largest, (zero.cloud.position[p] - predicted.cloud.position[p]).norm());
			return largest;
		}
	};

	TEST(Predictor, HalvesTheSolvesOfTheSlopeAndLeavesItsStates)
	{
		const Runs runs(40);
		EXPECT_EQ(runs.starts, 39);
		EXPECT_LT(runs.solves[1], 0.55 * runs.solves[0]) << runs.solves[1] << " instead of " << runs.solves[0];
		EXPECT_LT(runs.difference(), 1e-4); // relative to displacements of 2.6 m: forty steps of a residual up to 1e-6
	}

	TEST(Predictor, IsNotFollowedIntoCoarseStepsThatFail)
	{
		const Runs runs(5);
		EXPECT_LT(runs.difference(), 1e-3);
		EXPECT_LE(runs.solves[1], 1.5 * runs.solves[0]) << runs.solves[1] << " instead of " << runs.solves[0];
	}

	/// An elastic block in cells of 1 m, with and without prediction.
	struct Blocks {
		Model<2>         model;
		PointCloud<2>    zero, predicted;
		LinearSolver     solver;
		LastIncrement<2> last;

		Blocks(const Index<2>& cells, const std::vector<ConstrainedBox<2>>& boxes) : zero(block<2>(model.grid, cells, 2)), predicted(zero)
		{
			model.materials = { { Hencky(1e6, 0.3), 1000 } };
			model.boundary  = Boundary<2>(boxes);
		}
		std::pair<StepReport, StepReport> step(const Load<2>& load)
		{
			return { loadStep(zero, model, load, solver), loadStep(predicted, model, load, solver, &last) };
		}
	};

	TEST(Predictor, PrescribedDisplacementsEnterInFull)
	{
		const Grid<2> grid;
		auto          base = wallBelow<2>(grid, 1, 0), top = held<2>(grid, { -infinity, 4 }, { infinity, 4 }, "y", { 0, -0.8 });
		base.fixed[0] = true;
		Blocks blocks({ 4, 4 }, { base, top });
		// The top of the body leaves the nodes that move it after less than half a cell.
		for (int i = 1; i <= 4; ++i) {
			const auto [a, b] = blocks.step({ Vec<2>::Zero(), i / 16., 1 / 16. });
			ASSERT_TRUE(a.converged() && b.converged()) << a.cause << b.cause;
			EXPECT_EQ(b.predicted, i > 1);
			for (std::size_t p = 0; p < blocks.zero.size(); ++p)
				EXPECT_LT((blocks.zero.position[p] - blocks.predicted.position[p]).norm(), 1e-5);
		}
	}

	// A body that is pushed ahead by more than a cell while its weight is put on. Zero, with the nodes that push it
	// moved, turns points inside out: its forces are no measure for the prediction.
	TEST(Predictor, IsNoSolutionBecauseZeroIsFarFromOne)
	{
		const Grid<2> grid;
		Blocks        blocks({ 6, 2 }, { wallBelow<2>(grid, 1, 0), held<2>(grid, { -infinity, -infinity }, { 4, infinity }, "x", { 3, 0 }) });
		for (int i = 1; i <= 2; ++i) {
			const auto [a, b] = blocks.step({ (i - 1) * Vec<2>(0, -10), i / 2., 1 / 2. });
			ASSERT_TRUE(a.converged() && b.converged()) << a.cause << b.cause;
			EXPECT_GT(b.iterations, 0);
		}
		for (std::size_t p = 0; p < blocks.zero.size(); ++p)
			EXPECT_LT((blocks.zero.stress[p].c - blocks.predicted.stress[p].c).norm(), 1) << p; // relative to stresses of 20 kPa
	}

} // namespace
} // namespace gimpm
