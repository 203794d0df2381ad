// SPDX-License-Identifier: GPL-2.0-or-later
// A second field at the nodes, solved for together with displacements: pressure in pores, or temperature. It is what
// the developer's page tells how to add.
#include "core/solvers/multigrid.hpp"
#include "derivatives.hpp"
#include "moving.hpp"
#include "seepage.hpp"

namespace gimpm::testFields {
namespace {

	using namespace seepage;

	/// True if there is a library for it.
	bool hasMultigrid()
	{
#ifdef MPM_PETSC
		Multigrid::openFrom(MPM_PETSC);
#endif
		return Multigrid::absence().empty();
	}

	constexpr double cuts[] = { 1e-1, 1e-3, 1e-5, 1e-8 };

	template <class Dimension> using Fields = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(Fields, BothDimensions, DimensionName);

	/// Displacements and pressure beside each other, as far as the last digits.
	TYPED_TEST(Fields, LinearOnesAreExactAtAnyCutOfTheCells)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto method : { LinearMethod::direct, LinearMethod::iterative })
			for (const double cut : cuts) {
				const double    strain = 0.02;
				const Body<Dim> plain(cut);
				Body<Dim>       body(cut, { Body<Dim>::farEnd(plain.model, strain * plain.length) });
				const auto      before         = body.cloud.position;
				body.model.newton.linearSolver = method;
				const StepReport report        = body.step();
				ASSERT_TRUE(report.converged()) << report.cause;
				EXPECT_EQ(report.luSolves, 0);
				EXPECT_EQ(report.conjugateGradients.iterations > 0, method == LinearMethod::iterative);
				for (std::size_t n = 0; n < body.nodes.size(); ++n)
					ASSERT_NEAR(body.value[n], body.linear(body.nodes[n]), 1e-8 * body.ends[1]) << cut;
				for (std::size_t p = 0; p < before.size(); ++p)
					for (int a = 0; a < Dim; ++a) {
						const double x = before[p][a] - body.model.grid.origin[a];
						ASSERT_NEAR(body.cloud.position[p][a] - before[p][a], a == 0 ? strain * x : 0, 1e-9 * strain * body.length)
						        << cut;
					}
				const double area = Dim == 2 ? (2 + cut) * body.h : (2 + cut) * body.h * 2 * body.h,
				             flow = (body.ends[1] - body.ends[0]) / body.length * area;
				double in         = 0;
				for (std::size_t n = 0; n < body.nodes.size(); ++n)
					if (body.nodes[n][0] > body.model.grid.origin[0] + body.length - 1e-9) in += body.flow[n];
				EXPECT_NEAR(in / flow, 1, 1e-9) << "what holds the pressure at one end feeds the flow";
			}
	}

	TYPED_TEST(Fields, TheirGhostPenaltyBoundsTheConditionNumber)
	{
		constexpr int Dim       = TypeParam::value;
		const auto    condition = [](double cut, double ghost) {
                        Body<Dim> body(cut);
                        body.medium.ghost = ghost;
                        // Conductivity as large as the stiffness, with the scale of the field.
                        body.medium.conductivity = 1 / body.young;
                        body.model.boundary      = Boundary<Dim>(
                                prescribedSurface<Dim>(body.model.grid, cellsOf<Dim>(4, 1, 2), [](const Vec<Dim>&) -> Vec<Dim> { return Vec<Dim>::Zero(); }));
                        return conditionEstimate(tangentStiffness(body.cloud, body.model));
		};
		EXPECT_LT(condition(1e-8, 0.01), 1.05 * condition(1e-4, 0.01));
		EXPECT_GT(condition(1e-8, 0), 1e3 * condition(1e-4, 0));
	}

	/// A temperature that is the same everywhere expands the body alike along all axes: E ln l = push T J, J =
	/// l^Dim.
	TYPED_TEST(Fields, WarmthExpandsTheBodyAsInTheClosedForm)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto method : { LinearMethod::direct, LinearMethod::iterative })
			for (const double cut : cuts) {
				Body<Dim> body(cut);
				body.medium.push = 20;
				body.ends[0] = body.ends[1]    = 1e3;
				body.before                    = 300;
				body.model.newton.linearSolver = method;
				body.model.newton.reuseFactor  = false;
				const auto       before        = body.cloud.position;
				const StepReport report        = body.step();
				ASSERT_TRUE(report.converged()) << report.cause;
				EXPECT_EQ(report.luSolves > 0, method == LinearMethod::direct)
				        << "the matrix is not symmetric: nothing cools by being stretched";
				EXPECT_LE(report.iterations, 6);
				double stretch = 1;
				for (int i = 0; i < 60; ++i)
					stretch = std::exp(20 * 1e3 / body.young * std::pow(stretch, Dim));
				for (std::size_t n = 0; n < body.nodes.size(); ++n)
					ASSERT_NEAR(body.value[n], 1e3, 1e-7) << cut;
				for (std::size_t p = 0; p < before.size(); ++p) {
					const Vec<Dim> expected = (stretch - 1) * (before[p] - body.model.grid.origin);
					ASSERT_LT((body.cloud.position[p] - before[p] - expected).norm(), 1e-8 * body.length) << cut;
				}
			}
	}

	/// Coupled one way, both ways, and so that the matrix is symmetric: each block of it along directions in one of
	/// the fields.
	TYPED_TEST(Fields, TheTangentIsThatOfTheForces)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto& [push, storage, sign, growth] : { std::tuple(20., 0., 1., 0.), std::tuple(1., 1., 1., 1e-4), std::tuple(1., 1., -1., 0.) }) {
			Body<Dim> body(0.3);
			body.medium = { 1e-7, growth, push, storage, sign, 0.01 };
			StepReport            report;
			const StepSystem<Dim> system(body.cloud, body.model, Load<Dim>(), report);
			const double          sizes[] = { 0.03, 5e3 };
			Random                random(3);
			const auto            inField = [&](int field, double part) {
                                Eigen::VectorXd x       = Eigen::VectorXd::Zero(system.map.size());
                                system.map.of(field, x) = random.vector(system.map.end(field) - system.map.begin(field), part * sizes[field]);
                                return x;
			};
			const Eigen::VectorXd x = inField(0, 1) + inField(1, 1);
			NodeMatrix<Dim>       K;
			Couplings             beside;
			Eigen::VectorXd       force;
			system.prepare(K, &beside);
			ASSERT_FALSE(system.evaluate(x, force, &K, nullptr, &beside));
			const auto at = [&](const Eigen::VectorXd& place) -> Eigen::VectorXd {
				system.evaluate(place, force, nullptr);
				return force;
			};
			const auto product = [&](const Eigen::VectorXd& direction) {
				Eigen::VectorXd result = Eigen::VectorXd::Zero(x.size());
				K.multiplyAdd(direction, result);
				beside.multiplyAdd(direction, result);
				return result;
			};
			for (const int column : { 0, 1 }) {
				const Eigen::VectorXd step = inField(column, 3e-3), tangent = product(step);
				const Eigen::VectorXd slope = (8 * (at(x + step) - at(x - step)) - (at(x + 2 * step) - at(x - 2 * step))) / 12;
				for (const int row : { 0, 1 }) {
					const double size  = system.map.of(row, slope).norm(),
					             error = (system.map.of(row, tangent) - system.map.of(row, slope)).norm();
					EXPECT_LE(error, 1e-7 * size) << row << column;
					EXPECT_EQ(size > 0, !(row == 1 && column == 0 && storage == 0)) << row << column;
				}
			}
			const Eigen::VectorXd a = inField(0, 1) + inField(1, 1), b = inField(0, 1) + inField(1, 1);
			const double          ab = a.dot(product(b)), ba = b.dot(product(a));
			EXPECT_EQ(system.isSymmetric(), sign < 0);
			EXPECT_EQ(std::abs(ab - ba) < 1e-11 * a.norm() * product(b).norm(), sign < 0);
		}
	}

	/// Volume that leaves is the loss of the body, and the order of convergence is that of Newton's method, for a
	/// symmetric matrix and for another one.
	TYPED_TEST(Fields, WaterThatLeavesIsTheLossOfVolume)
	{
		constexpr int Dim = TypeParam::value;
		for (const double sign : { 1., -1. }) {
			Body<Dim> body(0.3);
			body.medium = { 1e-8, 0, 1, 1, sign, 0.01 };
			// Above that at the ends: the body has been swollen by nothing, and now it shrinks.
			body.before  = 4e4;
			body.ends[0] = -2e4, body.ends[1] = -5e4;
			body.model.newton.reuseFactor = false;
			body.model.newton.tolerance   = 1e-12;
			const auto volume             = [&] {
                                double sum = 0;
                                for (std::size_t p = 0; p < body.cloud.size(); ++p)
                                        sum += body.cloud.volume0[p] * body.cloud.volumeRatio(p);
                                return sum;
			};
			const double     before = volume();
			const StepReport report = body.step();
			ASSERT_TRUE(report.converged()) << report.cause;
			EXPECT_GT(report.luSolves, 0) << "symmetric, but not positive definite";
			EXPECT_GT(std::abs(volume() / before - 1), 0.004);
			EXPECT_NEAR(sign * body.flow.sum() / (volume() - before), 1, 1e-10);
			EXPECT_GT(convergenceOrder(report.residuals, 1e-13), 1.7);
		}
	}

	/// Water that leaves, which makes the matrix symmetric and indefinite, or of no symmetry; warmth that goes one
	/// way; a flow that is not linear. In several steps, each from what the last one has left.
	TYPED_TEST(Fields, AreTheSameByAllMethods)
	{
		constexpr int Dim   = TypeParam::value;
		const bool    hasIt = hasMultigrid();
		for (const Medium& medium : { Medium { 1e-8, 0, 1, 1, -1, 0.01 }, Medium { 1e-8, 0, 1, 1, 1, 0.01 }, Medium { 1e-7, 0, 2, 0, 1, 0.01 },
		                              Medium { 1e-8, 1e-4, 1, 1, 1, 0.01 } }) {
			std::vector<std::pair<PointCloud<Dim>, Eigen::VectorXd>> found;
			for (const auto method : { LinearMethod::direct, LinearMethod::iterative, LinearMethod::multigrid }) {
				if (method == LinearMethod::multigrid && !hasIt) continue;
				Body<Dim> body(0.3);
				body.medium                    = medium;
				body.model.newton.linearSolver = method;
				body.model.newton.tolerance    = 1e-12;
				for (int step = 0; step < 3; ++step) {
					body.ends[0] += 5e3, body.ends[1] -= 2e3;
					const StepReport report = body.step();
					ASSERT_TRUE(report.converged()) << report.cause;
					EXPECT_EQ(report.conjugateGradients.iterations > 0, method != LinearMethod::direct);
					if (step == 0) {
						EXPECT_EQ(report.conjugateGradients.hierarchies > 0, method == LinearMethod::multigrid);
					}
					EXPECT_EQ(report.conjugateGradients.fallbacks, 0) << report.conjugateGradients.reason;
					body.before = body.value.mean();
				}
				found.push_back({ body.cloud, body.value });
			}
			for (const auto& [cloud, value] : found) {
				EXPECT_LT((value - found[0].second).template lpNorm<Eigen::Infinity>(), 1e-8 * value.template lpNorm<Eigen::Infinity>());
				for (std::size_t p = 0; p < cloud.size(); ++p)
					ASSERT_LT((cloud.position[p] - found[0].first.position[p]).norm(), 1e-10 * Body<Dim>::length);
			}
		}
	}

	/// The flow is smaller than the forces by 16 powers of ten, and in balance all the same.
	TYPED_TEST(Fields, EachIsMeasuredByItself)
	{
		constexpr int   Dim = TypeParam::value;
		const Body<Dim> plain(0.3);
		Body<Dim>       body(0.3, { Body<Dim>::farEnd(plain.model, 0.02 * plain.length) });
		body.medium.conductivity      = 1e-20;
		body.medium.growth            = 1e-3;
		body.model.newton.reuseFactor = false;
		const StepReport report       = body.step();
		ASSERT_TRUE(report.converged()) << report.cause;
		EXPECT_GT(report.iterations, 3);
		const double P0 = body.ends[0], P1 = body.ends[1], b = body.medium.growth, slope = (P1 - P0) * (1 + b * (P0 + P1) / 2) / body.length;
		double       in = 0, out = 0;
		for (std::size_t n = 0; n < body.nodes.size(); ++n)
			if (const double x = body.nodes[n][0] - body.model.grid.origin[0]; x < 1e-9) out -= body.flow[n];
			else if (x > body.length - 1e-9)
				in += body.flow[n];
		EXPECT_NEAR(in / out, 1, 1e-9);
		EXPECT_NEAR(in / (1e-20 * slope * 2.3 * body.h * (Dim == 3 ? 2 * body.h : 1)), 1, 0.01);
		body.model.newton.maxIterations = 2;
		body.ends[1]                    = 9e3;
		const StepReport other          = body.step();
		EXPECT_EQ(other.failure, Failure::tooManyIterations);
		EXPECT_EQ(other.worst.axis, -1);
		EXPECT_EQ(other.worst.field, "pressure");
		EXPECT_NE(other.cause.find("most of it is of the pressure"), std::string::npos) << other.cause;
	}

	/// A large value that is the same everywhere leaves flows of round-off, which are none.
	TYPED_TEST(Fields, RoundOffOfLargeValuesIsNoFlow)
	{
		Body<TypeParam::value> body(1e-3);
		body.before = body.ends[0] = body.ends[1] = 1. / 3 * 1e9;
		ASSERT_TRUE(body.step().converged());
		body.ends[0] = body.ends[1]    = 1. / 7 * 1e9;
		body.model.newton.linearSolver = LinearMethod::iterative;
		const StepReport report        = body.step();
		ASSERT_TRUE(report.converged()) << report.cause;
		EXPECT_LE(report.iterations, 3);
	}

	TEST(Fields, AreRefusedByNameWhereTheyAreNotKnown)
	{
		Body<2> body(0.3);
		body.model.coupledTerms.clear();
		EXPECT_EQ(body.step().cause, "no term is for the field 'pressure'");

		Body<2>   field(0.3);
		Moving<2> inTime(1, Hencky(1e6, 0), 1000, TimeScheme::centralDifferences());
		inTime.put(field.cloud, [](const Vec<2>&) { return Vec<2>(Vec<2>::Zero()); });
		inTime.model.grid           = field.model.grid;
		inTime.model.fields         = field.model.fields;
		inTime.model.coupledTerms   = field.model.coupledTerms;
		const StepReport explicitly = inTime.step(1e-4);
		EXPECT_EQ(explicitly.failure, Failure::misplaced);
		EXPECT_EQ(explicitly.cause, "explicit steps are for displacements only, and there is the field 'pressure'");
	}

	/// Settlement of a column on an impermeable base under a load, which drains at its top, is that of
	/// Terzaghi's series.
	TEST(Fields, AColumnConsolidates)
	{
		constexpr int cells = 10, steps = 40;
		// Up to T = 0.5.
		constexpr double h = 0.1, young = 1e6, kappa = 1e-8, load = 100, duration = 0.5 / (kappa * young) / steps;
		Model<2>         model;
		model.grid.cellSize = h;
		model.materials     = { { Hencky(young, 0), 0 } };
		model.boundary      = Boundary<2>({ wallBelow<2>(model.grid, 1, 0), wallBelow<2>(model.grid, 0, 0), wallAbove<2>(model.grid, 0, h) });
		PointCloud<2> cloud = block<2>(model.grid, { 1, cells }, 2);
		cloud.force.assign(cloud.size(), Vec<2>::Zero());
		cloud.force[cloud.size() - 1][1] = cloud.force[cloud.size() - 2][1] = -load * h / 2;
		const double    top                                                 = cloud.position.back()[1];
		const Medium    medium { kappa * duration, 0, 1, 1, -1, 0.01 };
		Eigen::VectorXd pressure;
		const auto      start = [&](const PointCloud<2>&, const CloudBasis<2>& basis, const Grid<2>& grid) {
                        FieldStart start { pressure.size() > 0 ? pressure : Eigen::VectorXd::Zero(Eigen::Index(basis.nodes.size())), {} };
                        const auto x = nodePositions(basis, grid);
                        for (std::size_t n = 0; n < x.size(); ++n)
                                if (x[n][1] > cells * h - 1e-9) start.prescribed[int(n)] = 0;
                        return start;
		};
		const auto keep    = [&](const CloudBasis<2>&, const Eigen::VectorXd& value, const Eigen::VectorXd&) { pressure = value; };
		model.fields       = { { { "pressure", "Pa", 1, young / h }, start, keep } };
		model.coupledTerms = { [&](const StepContext<2>& step, const State&) { return std::make_unique<Flow<2>>(medium, step); } };
		LinearSolver solver;
		for (int step = 0; step < steps; ++step) {
			const auto report = loadStep<2>(cloud, model, { Vec<2>::Zero(), { 1, step == 0 ? 1. : 0. } }, solver);
			ASSERT_TRUE(report.converged()) << report.cause;
		}
		double degree = 1;
		for (int k = 0; k < 50; ++k) {
			const double m = M_PI * (2 * k + 1) / 2;
			degree -= 2 / (m * m) * std::exp(-m * m * 0.5);
		}
		// a quarter of the load acts at the lower nodes of the uppermost cell
		const double settled = (top - cloud.position.back()[1]) / (load / young * ((cells - 1) * h + 0.75 * 0.75 * h));
		EXPECT_NEAR(settled / degree, 1, 0.02);
	}

} // namespace
} // namespace gimpm::testFields
