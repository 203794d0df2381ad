// SPDX-License-Identifier: GPL-2.0-or-later
// Water that flows through cells of several sizes: exact fields, consolidation, rest and rain.
#include "refined.hpp"
#include "wet_soil.hpp"

namespace gimpm::testRefinedFlow {
namespace {

	constexpr double weight = 1e4; // of water [N/m3]

	/// Soil that fills so many of the largest cells, 2^Dim points a leaf.
	template <int Dim> struct RefinedSoil : Soil<Dim> {
		RefinedSoil(const Grid<Dim>& grid, const Index<Dim>& size, double modulus)
		        : Soil<Dim>(grid.cellSize, Vec<Dim>::Constant(grid.cellSize), false, modulus)
		{
			this->model.grid = grid;
			this->cloud      = refinedBlock<Dim>(grid, size, 2);
			this->water.pressure.assign(this->cloud.size(), 0);
			std::vector<ConstrainedBox<Dim>> walls;
			for (int a = 0; a < Dim; ++a) {
				walls.push_back(wallBelow<Dim>(grid, a, 0));
				if (a != 1) walls.push_back(wallAbove<Dim>(grid, a, size[a]));
			}
			this->model.boundary = Boundary<Dim>(walls);
		}
	};

	const Retention sand { Retention::Curve::vanGenuchten, Retention::Permeability::mualem, 3.35 / weight, 2, 0.102 / 0.368, 1 };

	/// A column of 8 largest cells, the upper ones of which are halved twice, with or without suction.
	struct Column : RefinedSoil<2> {
		explicit Column(double modulus, bool isDrying = false) : RefinedSoil(refinedGrid<2>({ { { 0.1, 6.1 }, { 0.9, 7.9 }, 2 } }), { 1, 8 }, modulus)
		{
			if (!isDrying) return;
			auto& whole              = water.whole.emplace();
			whole.weight             = { 0, -weight };
			whole.curves             = { std::make_shared<Retention>(sand) };
			whole.factor             = 0;
			water.pores              = { { 1e-5 / weight, 0.4 } };
			water.pores[0].retention = whole.curves[0].get();
			model.newton.tolerance   = 1e-12;
		}
		Surface<2> top() const { return line({ 1, 8 }, { 0, 8 }); }
		Surface<2> base() const { return line({ 0, 0 }, { 1, 0 }); }

		/// As at rest, with the water table in a height.
		void giveSuction(double height)
		{
			for (std::size_t p = 0; p < cloud.size(); ++p)
				water.pressure[p] = weight * (height - cloud.position[p][1]);
		}
	};

	/// Water flows from end to end: the pressure is linear across the sizes.
	TEST(RefinedFlow, LinearPressuresAreExactAcrossTheSizes)
	{
		constexpr double first = 3e3, rate = 2e-5, duration = 1e9, slope = rate / 1e-8;
		RefinedSoil<2>   body(refinedGrid<2>({ { { 2.1, 0.6 }, { 2.3, 0.8 }, 2 } }), { 5, 3 }, 1e16);
		body.drain(line({ 0, 3 }, { 0, 0 }), Drain<2>::Kind::pressure, first);
		body.drain(line({ 5, 0 }, { 5, 3 }), Drain<2>::Kind::flux, -rate);
		for (int k = 0; k < 2; ++k) {
			ASSERT_TRUE(body.step(k == 0 ? duration : duration / 1e6).converged());
			for (std::size_t p = 0; p < body.cloud.size(); ++p) {
				ASSERT_NEAR(body.water.pressure[p] / (first + slope / 30 + slope * body.cloud.position[p][0]), 1, 1e-10);
				ASSERT_NEAR(body.water.flux[p][0] / -rate, 1, 1e-10);
				ASSERT_NEAR(body.water.flux[p][1] / rate, 0, 1e-10);
			}
		}
	}

	/// A linear pressure is found again from that of the points, in the plane and in space.
	template <int Dim> void expectStart()
	{
		for (const bool isWhole : { false, true }) {
			const Vec<Dim>   slope = Vec<Dim>::LinSpaced(1e3, 3e3);
			RefinedSoil<Dim> body(cornerGrid<Dim>(), cornerSize<Dim>(), 1e6);
			if (isWhole) body.water.whole.emplace().weight.setZero();
			for (std::size_t p = 0; p < body.cloud.size(); ++p)
				body.water.pressure[p] = slope.dot(body.cloud.position[p]);
			StepReport            report;
			const StepSystem<Dim> system(body.cloud, body.model, Load<Dim>(), report);
			const Eigen::VectorXd P = system.state(Eigen::VectorXd::Zero(system.map.size())).value(1);
			for (std::size_t n = 0; n < system.basis.nodes.size(); ++n)
				ASSERT_NEAR(P[n], slope.dot(body.model.grid.nodePosition(Grid<Dim>::index(system.basis.nodes[n]))), 1e-7);
		}
	}
	TEST(RefinedFlow, NodesFindTheLinearPressureOfTheirPoints)
	{
		expectStart<2>();
		expectStart<3>();
	}

	/// Terzaghi's series, as closely as on equal cells.
	TEST(RefinedFlow, ColumnsConsolidateAsInTheSeries)
	{
		constexpr int    steps = 40;
		constexpr double q = 1e-3 * Column::young, height = 8;
		Column           column(Column::young);
		column.drain(column.top(), Drain<2>::Kind::pressure, 0);
		column.push(column.top(), { 0, -q });
		const double unit = height * height / (1e-8 * Column::young);
		double       T    = 0;
		for (int k = 1; k <= steps; ++k) {
			const double next   = 0.5 * k * k / double(steps * steps);
			const auto   report = column.step((next - T) * unit);
			ASSERT_TRUE(report.converged()) << report.cause;
			EXPECT_LE(report.iterations, 3);
			T = next;
			EXPECT_NEAR(column.out() / -column.water.stored, 1, 1e-9);
			const double settlement = height - column.water.drains[0].surface.vertices[0][1],
			             error      = settlement / (q / Column::young * height) - terzaghi(T);
			EXPECT_LT(std::abs(error), T > 0.02 ? 0.01 : 0.05) << T;
		}
	}

	TEST(RefinedFlow, SuctionAtRestStays)
	{
		Column column(1e12, true);
		column.giveSuction(7.5);
		column.drain(column.base(), Drain<2>::Kind::pressure, 7.5 * weight);
		for (int k = 0; k < 3; ++k)
			ASSERT_TRUE(column.step(1e9).converged());
		for (std::size_t p = 0; p < column.cloud.size(); ++p)
			EXPECT_NEAR(column.water.pressure[p], weight * (7.5 - column.cloud.position[p][1]), 1e-10 * 8 * weight);
	}

	/// All of the rain enters, from small cells into large ones, and none is lost.
	TEST(RefinedFlow, RainGoesDownThroughTheSizes)
	{
		constexpr double rain = 2e-6, end = 5e5;
		Column           column(1e10, true);
		column.giveSuction(5);
		column.drain(column.top(), Drain<2>::Kind::rain, rain);
		column.drain(column.base(), Drain<2>::Kind::pressure, 5 * weight);
		const auto before = column.water.pressure;
		for (double time = 0, duration = 2000; time < end;) {
			if (const auto report = column.step(duration); !report.converged()) {
				ASSERT_GT(duration /= 2, 10) << report.cause << " at " << time;
				continue;
			}
			time += duration, duration = std::min(1.2 * duration, 8000.);
			ASSERT_NEAR(-column.water.drains[0].out / (rain * column.water.duration), 1, 1e-9);
			ASSERT_NEAR((column.out() + column.water.stored) / (rain * column.water.duration), 0, 1e-9);
		}
		for (std::size_t p = 0; p < before.size(); ++p)
			if (const double y = column.cloud.position[p][1]; y > 5.5 && y < 6) {
				EXPECT_GT(column.water.pressure[p], before[p] + 0.05 * weight);
			}
	}

} // namespace
} // namespace gimpm::testRefinedFlow
