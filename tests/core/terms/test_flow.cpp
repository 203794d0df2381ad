// SPDX-License-Identifier: GPL-2.0-or-later
// Water that flows through a soil which deforms: tangent, balance, exact fields, and columns that consolidate.
#include "core/solvers/condition.hpp"
#include "derivatives.hpp"
#include "wet_soil.hpp"

namespace gimpm::testFlow {
namespace {

	using Kind = Drain<2>::Kind;

	/// One cell wide, on a base, under a load on its top, through which water leaves.
	struct Column : Soil<2> {
		double height, load;
		Column(int cells, double cut, double load, double skin = 30) : Soil(1 / (cells + cut), { 1 / (cells + cut), 1 }), height(1), load(load)
		{
			hold({ wallAbove<2>(model.grid, 0, h) });
			const auto top                            = line({ h, height }, { 0, height });
			drain(top, Kind::pressure, 0).conductance = skin;
			push(top, { 0, -load });
		}
		double settlement() const { return height - water.drains[0].surface.vertices[0][1]; }
		double coefficient() const { return water.pores[0].conductivity * young; } // coefficient of consolidation
	};

	/// Tangent of the forces, which is symmetric with the sign of the pressures' rows where nothing flows and water
	/// keeps its volume.
	template <int Dim> void expectTangent(Soil<Dim>& body, bool flows, double verticalRatio = 1)
	{
		body.water.modulus  = flows ? 2e6 : infinity;
		body.water.duration = flows ? 3 : 0;
		body.water.pores    = { { 1e-7, 0.4, Pores::Law::kozenyCarman } };
		body.water.vertical << 0.6, Vec<Dim - 1>::Unit(Dim - 2) * 0.8;
		body.water.pores[0].verticalRatio = verticalRatio;
		Random random(3);
		for (auto& pressure : body.water.pressure)
			pressure = random.in(-1e4, 1e4);
		StepReport            report;
		const StepSystem<Dim> system(body.cloud, body.model, Load<Dim>(), report);
		const double          sizes[] = { 0.02 * body.h, 3e4 };
		const auto            in      = [&](int field, double part) {
                        Eigen::VectorXd x       = Eigen::VectorXd::Zero(system.map.size());
                        system.map.of(field, x) = random.vector(system.map.end(field) - system.map.begin(field), part * sizes[field]);
                        return x;
		};
		const Eigen::VectorXd x = in(0, 1) + in(1, 1);
		EXPECT_TRUE(system.isSymmetric());
		if (flows) {
			EXPECT_TRUE(system.makeExact() && !system.makeExact() && !system.isSymmetric());
		}
		for (const int column : { 0, 1 }) {
			const auto [tangent, slope] = coupledDerivatives(system, x, in(column, 1e-2));
			for (const int row : { 0, 1 })
				EXPECT_LE((system.map.of(row, tangent) - system.map.of(row, slope)).norm(), 1e-7 * system.map.of(row, slope).norm())
				        << row << column;
		}
	}

	/// Forces on all nodes are then next to nothing, and round-off is that of what was there before.
	TEST(Flow, PressureOfAllSoilMayVanishAtOnce)
	{
		Soil<2> soil(0.25, { 4, 2 });
		soil.hold({ wallAbove<2>(soil.model.grid, 0, 4) });
		soil.water.pressure.assign(soil.cloud.size(), 1e3);
		soil.drain(line({ 0, 2 }, { 0, 0 }), Drain<2>::Kind::pressure, 0);
		ASSERT_TRUE(soil.step(0.01).converged());
		EXPECT_NEAR(*std::max_element(soil.water.pressure.begin(), soil.water.pressure.end()), 0, 1e-6);
	}

	TEST(Flow, TheTangentIsThatOfTheForces)
	{
		Soil<2> plane(0.5, { 1.7, 1.2 });
		plane.drain(line({ 1.7, 1.2 }, { 0, 1.2 }), Kind::pressure, 1e3);
		Soil<3> space(0.5, { 1.2, 1.7, 1 });
		Soil<2> ring(0.5, { 1.7, 1.2 }, true);
		ring.drain(line({ 1.7, 0 }, { 1.7, 1.2 }), Kind::pressure, 1e3);
		for (const bool flows : { true, false }) {
			expectTangent(plane, flows);
			expectTangent(space, flows);
			expectTangent(ring, flows);
		}
		expectTangent(plane, true, 0.1);
		expectTangent(space, true, 10);
		expectTangent(ring, true, 0.1);
	}

	/// The term of flow that has no transpose is left out: one iteration more at most, and the same solution. Where
	/// it counts, Newton's method takes it in.
	TEST(Flow, ASymmetricTangentLeadsToTheSameInAboutAsManyIterations)
	{
		const auto run = [](double part, double load, bool isExact, StepReport& report) {
			Column column(10, 0.3, load * Column::young);
			column.model.newton.tolerance = 1e-6;
			if (isExact)
				column.model.coupledTerms = { [&column](const StepContext<2>& step, const State& begin) {
					auto flow         = std::make_unique<Flow<2>>(
                                                column.water, [&column](int) { return column.model.materials[0].young({}, 0); }, step, begin);
					flow->makeExact();
					return flow;
				} };
			report = column.step(part * column.h * column.h / column.coefficient());
			EXPECT_TRUE(report.converged()) << report.cause;
			return column.settlement();
		};
		for (const auto& [part, load] : { std::pair(0.01, 0.1), std::pair(1., 0.1), std::pair(100., 0.1), std::pair(100., 0.01) }) {
			StepReport   exact, symmetric;
			const double settlement = run(part, load, true, exact);
			EXPECT_NEAR(run(part, load, false, symmetric) / settlement, 1, 1e-6);
			EXPECT_LE(symmetric.iterations, exact.iterations + 1) << part << " " << load;
		}
	}

	/// A reservoir that stands before a face: pressures below its level, and above it water can leave only.
	TEST(Flow, ALevelBeforeAFaceIsAPressureBelowItAndAirAbove)
	{
		for (const double level : { 0.4, 2. }) {
			Soil<2> body(0.25, { 2, 1 }, false, 1e12);
			for (const bool isLeft : { true, false }) {
				auto& face = body.drain(isLeft ? line({ 0, 1 }, { 0, 0 }) : line({ 2, 0 }, { 2, 1 }), Kind::pressure, 0);
				face.level = { isLeft ? 2 : level, 2, 1e4, 1, 1 };
			}
			ASSERT_TRUE(body.step(1e9).converged());
			if (level == 2) {
				EXPECT_EQ(body.water.drains[0].out, 0);
				EXPECT_EQ(body.water.drains[1].out, 0);
				continue;
			}
			EXPECT_NEAR(body.water.drains[0].out / body.water.drains[1].out, -1, 1e-6);
			// More than with a free surface (Dupuit), which is not looked for, less than with water before
			// all of both faces.
			const double flow = body.water.drains[1].out / 1e9, lower = 1e-8 * 1e4 * (1 - 0.16) / (2 * 2);
			EXPECT_GT(flow, lower);
			EXPECT_LT(flow, 1e-8 * 1e4 * (2 - 0.4) * 1 / 2);
			for (std::size_t p = 0; p < body.cloud.size(); ++p)
				EXPECT_LE(body.water.pressure[p], body.cloud.position[p][0] > 1.9 ? -1e4 * (2 - 1.2) : 1e-6);
		}
	}

	/// Water flows from end to end: the pressure is linear but for the skins, at any cut of the cells, and with any
	/// conductivity across. The soil is so stiff that it hardly moves.
	TEST(Flow, LinearPressuresAreExactAtAnyCutOfTheCells)
	{
		for (const auto& [cut, ratio] : { std::pair(0., 1.), { 1e-1, 1 }, { 0.5, 1 }, { 1e-3, 1 }, { 1e-6, 1 }, { 0.3, 0.01 }, { 1e-6, 100 } }) {
			constexpr double h = 0.5, stiff = 1e16, first = 3e3, rate = 2e-5;
			const double     length = (4 + cut) * h, width = (2 + cut) * h;
			Soil<2>          body(h, { length, width }, false, stiff);
			body.water.vertical = { 1, 0 }, body.water.pores[0].verticalRatio = ratio;
			body.drain(line({ 0, width }, { 0, 0 }), Kind::pressure, first);
			body.drain(line({ length, 0 }, { length, width }), Kind::flux, -rate);
			const double slope = rate / (ratio * 1e-8), duration = 1e9;
			ASSERT_TRUE(body.step(duration).converged());
			const double skin = h / 30 * slope;
			for (std::size_t p = 0; p < body.cloud.size(); ++p) {
				const Vec<2> x = body.cloud.position[p];
				ASSERT_NEAR(body.water.pressure[p] / (first + skin + slope * x[0]), 1, 1e-10) << cut;
				ASSERT_NEAR(body.water.flux[p][0] / -rate, 1, 1e-10) << cut;
				ASSERT_NEAR(body.water.flux[p][1] / rate, 0, 1e-10) << cut;
			}
			EXPECT_NEAR(body.water.drains[0].out / (rate * width * duration), 1, 1e-10);
			// Another step leaves all as it is: penalties are on what grows.
			const auto before = body.water.pressure;
			ASSERT_TRUE(body.step(duration / 1e6).converged());
			for (std::size_t p = 0; p < before.size(); ++p)
				ASSERT_NEAR(body.water.pressure[p] / before[p], 1, 1e-10);
		}
	}

	TEST(Flow, ColumnsConsolidateAsInTheSeriesAtAnyCut)
	{
		constexpr int cells = 20, steps = 40;
		for (const double cut : { 0., 0.1, 0.3, 0.5, 0.9 }) {
			constexpr double q = 1e-3 * Column::young;
			Column           column(cells, cut, q);
			double           T = 0;
			for (int k = 1; k <= steps; ++k) {
				const double next   = 0.5 * k * k / double(steps * steps);
				const auto   report = column.step((next - T) / column.coefficient());
				ASSERT_TRUE(report.converged()) << report.cause;
				T = next;
				EXPECT_NEAR(column.out() / -column.water.stored, 1, 1e-9);
				const double error = column.settlement() / (q / Column::young) - terzaghi(T);
				EXPECT_LT(std::abs(error), T > 0.02 ? 0.01 : 0.05) << cut << " T = " << T;
			}
		}
	}

	/// q / M = 0.2, Kozeny and Carman's law with n = 0.6: values of a finer method for the equation in one
	/// dimension.
	TEST(Flow, ColumnsThatLoseASeventhOfTheirHeightConsolidateAsTheyMust)
	{
		constexpr int                   cells = 20, steps = 80;
		const std::pair<double, double> expected[] = { { 0.2, 0.077177 }, { 0.5, 0.117142 }, { 1, 0.143536 } };
		Column                          column(cells, 0.3, 0.2 * Column::young, 100);
		column.water.pores            = { { 1e-8, 0.6, Pores::Law::kozenyCarman } };
		column.model.newton.tolerance = 1e-12;
		double T = 0, out = 0, stored = 0, before = 0;
		for (int k = 1; k <= steps; ++k) {
			const double next   = k * k / double(steps * steps);
			const auto   report = column.step((next - T) / column.coefficient());
			ASSERT_TRUE(report.converged()) << report.cause;
			EXPECT_LE(report.iterations, 6); // same as with all derivatives from the start
			for (const auto& [time, settlement] : expected)
				if (T < time && next >= time - 1e-9) {
					const double part  = (time - T) / (next - T); // part of this step
					const double found = column.settlement() - (1 - part) * (column.settlement() - before);
					EXPECT_NEAR(found / settlement, 1, 0.01) << time;
				}
			before = column.settlement();
			EXPECT_NEAR(column.out() + column.water.stored, 0, 1e-12 * column.h);
			out += column.out(), stored += column.water.stored;
			T = next;
		}
		double volume = 0;
		for (std::size_t p = 0; p < column.cloud.size(); ++p)
			volume += column.cloud.volume0[p] * column.cloud.volumeRatio(p);
		EXPECT_NEAR(out / (column.h - volume), 1, 1e-10) << "what has left is what the column has lost";
		EXPECT_NEAR(out / -stored, 1, 1e-12);
	}

	/// The column is the same in the plane, in space and as a cylinder, with Poisson's ratio zero.
	TEST(Flow, SpaceAndBodiesOfRevolutionAgreeWithThePlane)
	{
		constexpr int    cells = 6;
		constexpr double load  = 1e5;
		Column           plane(cells, 0, load);
		Soil<2>          ring(plane.h, { plane.h, 1 }, true);
		Soil<3>          space(plane.h, { plane.h, 1, plane.h });
		ring.hold({ wallAbove<2>(ring.model.grid, 0, ring.h) });
		space.hold({ wallAbove<3>(space.model.grid, 0, space.h), wallAbove<3>(space.model.grid, 2, space.h) });
		const auto top = line({ ring.h, 1 }, { 0, 1 });
		ring.drain(top, Kind::pressure, 0);
		ring.push(top, { 0, -load });
		const double     h = space.h;
		const Surface<3> lid { { { 0, 1, 0 }, { 0, 1, h }, { h, 1, h }, { h, 1, 0 } },
			               { { 0, 1, 0 }, { 0, 1, h }, { h, 1, h }, { h, 1, 0 } },
			               { { 0, 1, 2 }, { 0, 2, 3 } } };
		space.drain(lid, Drain<3>::Kind::pressure, 0);
		space.push(lid, { 0, -load, 0 });
		for (int step = 1; step <= 5; ++step) {
			const double duration = 0.02 * step / plane.coefficient();
			ASSERT_TRUE(plane.step(duration).converged() && ring.step(duration).converged() && space.step(duration).converged());
			EXPECT_NEAR(space.out() / (plane.out() * h), 1, 1e-4);
			EXPECT_NEAR(ring.out() / (plane.out() * M_PI * h), 1, 1e-3);
		}
	}

	TEST(Flow, FirstStepsAreFreeOfOscillation)
	{
		for (const double part : { 1e-6, 1e-2, 0.1, 1. })
			for (const double stabilisation : { 0., 1. }) {
				Column column(20, 0, 1e-3 * Column::young, 1e7); // same as without a skin
				column.water.stabilisation = stabilisation;
				ASSERT_TRUE(column.step(part * column.h * column.h / column.coefficient()).converged());
				double most = 0;
				for (const double pressure : column.water.pressure)
					most = std::max(most, pressure / column.load);
				if (stabilisation > 0 || part == 1) {
					EXPECT_LT(most, 1.3) << part;
				} else if (part < 1e-5) {
					EXPECT_GT(most, 1.3) << "without it there are some";
				}
			}
	}

	TEST(Flow, TheConditionNumberIsBoundedAtAnyCut)
	{
		const auto condition = [](double cut, double conductivity, double ghost) {
			Soil<2> body(0.5, { 2, (2 + cut) * 0.5 });
			body.drain(line({ 0, (2 + cut) * 0.5 }, { 0, 0 }), Kind::pressure, 0);
			body.hold({ held<2>(body.model.grid, Vec<2>::Constant(-infinity), Vec<2>(0, infinity), "xy") });
			body.water.pores[0].conductivity = conductivity;
			body.water.duration              = 1;
			body.water.ghost                 = ghost;
			return conditionEstimate(tangentStiffness(body.cloud, body.model));
		};
		for (const double conductivity : { 1e-14, 1e-7, 1e-5 })
			EXPECT_LT(condition(1e-8, conductivity, 0.01), 1.5 * condition(1e-3, conductivity, 0.01)) << conductivity;
		EXPECT_GT(condition(1e-8, 1e-14, 0), 1e3 * condition(1e-3, 1e-14, 0));
	}

	TEST(Flow, WaterThatCannotLeaveIsRefused)
	{
		Soil<2> body(0.5, { 1.5, 1 });
		body.hold({ wallAbove<2>(body.model.grid, 0, 1.5), wallAbove<2>(body.model.grid, 1, 1) });
		const auto report = body.step(1);
		EXPECT_EQ(report.failure, Failure::misplaced);
		EXPECT_NE(report.cause.find("there is no drain"), std::string::npos) << report.cause;
		body.water.modulus = 2e9;
		EXPECT_TRUE(body.step(1).converged());
		Soil<2> dry(0.5, { 1.5, 1 });
		dry.drain(line({ 3, 0 }, { 3, 1 }), Kind::pressure, 0).name = "a way out";
		EXPECT_EQ(dry.step(1).cause.find("a way out has a vertex at (3"), 0u) << dry.step(1).cause;
	}

	TEST(Flow, AFaceThatLetsWaterOutOnlyClosesAndOpens)
	{
		for (const double inside : { -2e3, 2e3 }) {
			Soil<2> body(0.5, { 2, 1 });
			body.drain(line({ 0, 1 }, { 0, 0 }), Kind::pressure, inside);
			body.drain(line({ 2, 0 }, { 2, 1 }), Kind::seepage, 0);
			ASSERT_TRUE(body.step(1e6).converged());
			EXPECT_EQ(body.water.drains[1].out > 0, inside > 0);
			EXPECT_EQ(body.water.drains[1].out == 0, inside < 0);
		}
	}

} // namespace
} // namespace gimpm::testFlow
