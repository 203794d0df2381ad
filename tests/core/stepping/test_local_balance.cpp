// SPDX-License-Identifier: GPL-2.0-or-later
// Convergence of every part of the body, however soft or lightly loaded beside the others.
#include "scenes.hpp"

namespace gimpm {
namespace {

	/// Columns one cell wide between smooth sides, on a smooth base; each has a box that holds its base.
	struct Columns {
		Model<2>                       model;
		PointCloud<2>                  cloud;
		std::vector<ConstrainedBox<2>> boxes;
		std::vector<double>            weight; ///< weight of each column [N]
		Load<2>                        load;
		LinearSolver                   solver;

		Columns() { load.gravity = { 0, -10 }; }

		void add(int x, int height, double young, double density, int from = 0)
		{
			const int material = int(model.materials.size());
			model.materials.push_back({ Hencky(young, 0), density });
			append(block<2>(model.grid, { 1, height }, 2, { x, from }), material);
			for (const int side : { 0, 1 })
				boxes.push_back(held<2>(model.grid, Vec<2>(x + side, -infinity), Vec<2>(x + side, infinity), "x"));
			boxes.push_back(held<2>(model.grid, Vec<2>(x, -infinity), Vec<2>(x + 1, 0), "y"));
			weight.push_back(10 * density * height);
		}
		void append(const PointCloud<2>& points, int material)
		{
			for (std::size_t i = 0; i < points.size(); ++i)
				addPoint<2>(cloud, points.position[i], points.halfSize[i], material);
		}
		/// Its top is pressed down.
		void press(int x, int top, double by) { boxes.push_back(held<2>(model.grid, Vec<2>(x, top), Vec<2>(x + 1, top), "y", Vec<2>(0, -by))); }

		/// In four steps of the same size. Returns the last report.
		StepReport run(double tolerance, LinearMethod method = LinearMethod::automatic)
		{
			model.boundary            = Boundary<2>(boxes);
			model.newton.tolerance    = tolerance;
			model.newton.linearSolver = method;
			StepReport report;
			for (int step = 1; step <= 4; ++step) {
				load.factor.value = step / 4., load.factor.growth = 1 / 4.;
				report = loadStep(cloud, model, load, solver);
				EXPECT_TRUE(report.converged()) << report.cause;
			}
			return report;
		}
		/// Reaction of the column added as number `column`.
		double reaction(const StepReport& report, int column) const { return report.reactions[3 * column + 2][1]; }
	};

	double largestDistance(const Columns& a, const Columns& b)
	{
		double largest = 0;
		for (std::size_t p = 0; p < a.cloud.size(); ++p)
			largest = std::max(largest, (a.cloud.position[p] - b.cloud.position[p]).norm());
		return largest;
	}

	Columns beside(double stiff)
	{
		Columns c;
		c.add(0, 16, 1e4, 80); // settles by a third of its height
		c.add(4, 10, 1e7, 2000);
		c.add(8, 4, stiff, 7800);
		c.press(8, 4, 1e-2);
		return c;
	}

	TEST(LocalBalance, SoftColumnsBesideAPressedStiffOneAreInBalance)
	{
		for (const double stiff : { 2e11, 1e13 })
			for (const auto method : { LinearMethod::direct, LinearMethod::iterative }) {
				Columns    c = beside(stiff), precise = beside(stiff);
				const auto report = c.run(1e-6, method);
				precise.run(1e-9);
				for (const int column : { 0, 1 })
					EXPECT_NEAR(c.reaction(report, column), c.weight[column], 1e-4 * c.weight[column]) << stiff << ", column " << column;
				EXPECT_LT(largestDistance(c, precise), 1e-4) << stiff;
				EXPECT_LE(report.localResidual, 3e-6);
			}
	}

	TEST(LocalBalance, ASoftPartOfOneBodyIsInBalance)
	{
		const auto scene = [] {
			Columns c;
			c.add(0, 4, 2e11, 7800);
			c.add(0, 16, 1e4, 80, 4); // on top of it
			// steel is wedged: its right side moves to the left
			c.boxes = { held<2>(c.model.grid, Vec<2>(0, -infinity), Vec<2>(0, infinity), "x"),
				    held<2>(c.model.grid, Vec<2>(1, -infinity), Vec<2>(1, 3), "x", Vec<2>(-1e-2, 0)),
				    held<2>(c.model.grid, Vec<2>(1, 4), Vec<2>(1, infinity), "x"),
				    held<2>(c.model.grid, Vec<2>(0, -infinity), Vec<2>(1, 0), "y") };
			return c;
		};
		Columns    c = scene(), precise = scene();
		const auto report = c.run(1e-6);
		precise.run(1e-9);
		// Points that reach behind the moving walls are constrained there, so that all boxes carry the weight.
		double reaction = 0;
		for (const auto& r : report.reactions)
			reaction += r[1];
		EXPECT_NEAR(reaction, c.weight[0] + c.weight[1], 1e-4 * c.weight[1]);
		EXPECT_LT(largestDistance(c, precise), 1e-4);
	}

	TEST(LocalBalance, PartsWithoutLoadCostNothing)
	{
		// an arm in the air, weightless and without stress, at the end of a block that is compressed
		for (const auto method : { LinearMethod::direct, LinearMethod::iterative }) {
			Columns c;
			c.add(0, 4, 1e6, 0);
			c.boxes.clear();
			c.append(block<2>(c.model.grid, { 12, 1 }, 2, { 1, 3 }), 0);
			c.boxes           = { held<2>(c.model.grid, Vec<2>(0, -infinity), Vec<2>(1, 0), "xy"),
				              held<2>(c.model.grid, Vec<2>(0, 3), Vec<2>(1, 3), "y", Vec<2>(0, -0.2)) };
			const auto report = c.run(1e-6, method);
			EXPECT_LE(report.iterations, 5);
		}
	}

	TEST(LocalBalance, AToleranceBelowRoundOffEndsWithTheOneThatCanBeAttained)
	{
		Columns c;
		c.add(0, 16, 1e5, 80);
		c.model.boundary         = Boundary<2>(c.boxes);
		c.model.newton.tolerance = 1e-20;
		auto report              = loadStep(c.cloud, c.model, c.load, c.solver);
		EXPECT_EQ(report.failure, Failure::stalled) << report.cause;
		EXPECT_LT(report.iterations, c.model.newton.maxIterations);
		const std::string known = "a tolerance of about ";
		ASSERT_NE(report.cause.find(known), std::string::npos) << report.cause;
		c.model.newton.tolerance = std::stod(report.cause.substr(report.cause.find(known) + known.size()));
		EXPECT_LT(c.model.newton.tolerance, 1e-12);
		report = loadStep(c.cloud, c.model, c.load, c.solver);
		EXPECT_TRUE(report.converged()) << report.cause;
	}

	TEST(LocalBalance, TheReportTellsOfTheLastMatrixFactorised)
	{
		Columns c;
		c.add(0, 4, 1e6, 80);
		EXPECT_EQ(c.run(1e-6, LinearMethod::direct).definiteness, Definiteness::positive);
		EXPECT_EQ(c.run(1e-6, LinearMethod::iterative).definiteness, Definiteness::notChecked);
		// A column on its head, free at the sides: it hangs from nothing but its prescribed ends, compressed
		// far beyond buckling.
		Model<2>      model;
		PointCloud<2> cloud = block<2>(model.grid, { 1, 20 }, 2);
		model.materials     = { { Hencky(1e6, 0), 0 } };
		model.boundary      = Boundary<2>({ held<2>(model.grid, Vec<2>(-infinity, -infinity), Vec<2>(infinity, 0), "xy"),
		                                    held<2>(model.grid, Vec<2>(-infinity, 20), Vec<2>(infinity, infinity), "xy", Vec<2>(0, -2)) });
		LinearSolver solver;
		StepReport   report;
		for (int step = 1; step <= 4; ++step) {
			Load<2> load;
			load.factor.value = step / 10., load.factor.growth = 1 / 10.;
			report = loadStep(cloud, model, load, solver);
			ASSERT_TRUE(report.converged()) << report.cause;
		}
		EXPECT_EQ(report.definiteness, Definiteness::indefinite) << "straight, and about to buckle";
		EXPECT_GT(report.luSolves, 0);
	}

} // namespace
} // namespace gimpm
