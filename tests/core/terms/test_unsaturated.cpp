// SPDX-License-Identifier: GPL-2.0-or-later
// Water in pores that need not be full: tangent, balance, rest, wetting fronts and rain.
#include "derivatives.hpp"
#include "wet_soil.hpp"

namespace gimpm::testUnsaturated {
namespace {

	constexpr double weight = 1e4; // of water [N/m3]

	/// Soil with pores that need not be full, and water that has its weight.
	template <int Dim> struct DryingSoil : Soil<Dim> {
		DryingSoil(double h, Vec<Dim> size, const Retention& law, double modulus, bool axisymmetric = false) : Soil<Dim>(h, size, axisymmetric, modulus)
		{
			auto& whole                    = this->water.whole.emplace();
			whole.weight                   = -weight * Vec<Dim>::Unit(1);
			whole.curves                   = { std::make_shared<Retention>(law) };
			whole.factor                   = 0;
			this->water.pores              = { { 1e-8, 0.4 } };
			this->water.pores[0].retention = whole.curves[0].get();
		}
		double outflow() const { return this->out(); }
	};

	const Retention sand { Retention::Curve::vanGenuchten, Retention::Permeability::mualem, 3.35 / weight, 2, 0.102 / 0.368, 1 };

	template <int Dim> void expectTangent(DryingSoil<Dim>& body, double verticalRatio = 1)
	{
		body.water.whole->factor = 0.7;
		body.water.modulus       = 2e6;
		body.water.duration      = 3;
		body.water.pores[0].law  = Pores::Law::kozenyCarman;
		body.water.vertical << 0.6, Vec<Dim - 1>::Unit(Dim - 2) * 0.8;
		body.water.pores[0].verticalRatio = verticalRatio;
		Random random(3);
		for (auto& pressure : body.water.pressure)
			pressure = random.in(-3e4, 1e4);
		StepReport            report;
		const StepSystem<Dim> system(body.cloud, body.model, Load<Dim>(), report);
		const double          absoluteContributions[] = { 0.02 * body.h, 1e4 };
		const auto            in                      = [&](int field, double part) {
                        Eigen::VectorXd x       = Eigen::VectorXd::Zero(system.map.size());
                        system.map.of(field, x) = random.vector(system.map.end(field) - system.map.begin(field), part * absoluteContributions[field]);
                        return x;
		};
		const Eigen::VectorXd x = in(0, 1) + in(1, 1);
		EXPECT_FALSE(system.isSymmetric());
		for (const int column : { 0, 1 }) {
			const auto [tangent, slope] = coupledDerivatives(system, x, in(column, 1e-3));
			for (const int row : { 0, 1 })
				EXPECT_LE((system.map.of(row, tangent) - system.map.of(row, slope)).norm(), 1e-6 * system.map.of(row, slope).norm())
				        << row << column;
		}
	}

	TEST(Unsaturated, TheTangentIsThatOfTheForces)
	{
		const Retention steep { Retention::Curve::exponential, Retention::Permeability::exponential, 1e-4, 0, 0.1, 0.95 };
		for (const Retention& law : { sand, steep })
			for (const Bishop bishop : { Bishop::effectiveSaturation, Bishop::saturation }) {
				DryingSoil<2> plane(0.5, { 1.7, 1.2 }, law, 1e6);
				DryingSoil<3> space(0.5, { 1.2, 1.7, 1 }, law, 1e6);
				DryingSoil<2> ring(0.5, { 1.7, 1.2 }, law, 1e6, true);
				plane.water.whole->bishop = space.water.whole->bishop = ring.water.whole->bishop = bishop;
				plane.drain(line({ 1.7, 1.2 }, { 0, 1.2 }), Drain<2>::Kind::rain, 1e-5);
				plane.drain(line({ 0, 1.2 }, { 0, 0 }), Drain<2>::Kind::seepage, 500);
				ring.drain(line({ 1.7, 0 }, { 1.7, 1.2 }), Drain<2>::Kind::pressure, -1e3);
				expectTangent(plane);
				expectTangent(space);
				expectTangent(ring);
				expectTangent(plane, 0.1);
			}
		Retention deforming    = sand;
		deforming.voidExponent = 2.5;
		DryingSoil<2> plane(0.5, { 1.7, 1.2 }, deforming, 1e6), ring(0.5, { 1.7, 1.2 }, deforming, 1e6, true);
		DryingSoil<3> space(0.5, { 1.2, 1.7, 1 }, deforming, 1e6);
		expectTangent(plane);
		expectTangent(space);
		expectTangent(ring);
	}

	/// One cell wide, one metre high, so stiff that it hardly moves.
	struct Column : DryingSoil<2> {
		Column(int cells, double cut, const Retention& law, double conductivity, double porosity, double pressure, double modulus = 1e12)
		        : DryingSoil(1 / (cells + cut), { 1 / (cells + cut), 1 }, law, modulus)
		{
			hold({ wallAbove<2>(model.grid, 0, h) });
			water.pores[0].conductivity = conductivity / weight, water.pores[0].porosity = porosity;
			water.pressure.assign(cloud.size(), pressure);
			model.newton.tolerance = 1e-12;
		}
		Surface<2> top() const { return line({ h, 1 }, { 0, 1 }); }
		Surface<2> base() const { return line({ 0, 0 }, { h, 0 }); }

		double content() const
		{
			double sum = 0;
			for (std::size_t p = 0; p < cloud.size(); ++p)
				sum += cloud.volume0[p] * (cloud.volumeRatio(p) - 1 + water.pores[0].porosity) * water.whole->saturation[p];
			return sum;
		}
		/// Until a time, by steps that grow as Newton's method allows; returns how many there were.
		int run(double end, double first, double largest)
		{
			int    steps = 0;
			double time = 0, duration = first;
			while (time < end * (1 - 1e-9)) {
				duration          = std::min(duration, end - time);
				const auto report = step(duration);
				if (!report.converged()) {
					duration /= 3;
					if (duration < 1e-4 * first) {
						ADD_FAILURE() << report.cause << " at " << time;
						return steps;
					}
					continue;
				}
				EXPECT_NEAR(out() + water.stored, 0, 1e-11 * content());
				if (!std::isnan(last_)) {
					EXPECT_NEAR(content() - last_, water.stored, 1e-12 * h);
				}
				last_ = content();
				time += duration, ++steps;
				if (report.iterations < 9) duration = std::min(1.3 * duration, largest);
			}
			return steps;
		}
		double pressureAt(double z) const
		{
			double above = infinity, below = -infinity, at = 0, under = 0;
			for (std::size_t p = 0; p < cloud.size(); ++p) {
				const double y = cloud.position[p][1];
				if (y >= z && y < above) above = y, at = water.pressure[p];
				if (y < z && y > below) below = y, under = water.pressure[p];
			}
			return under + (at - under) * (z - below) / (above - below);
		}

	private:
		double last_ = std::numeric_limits<double>::quiet_NaN();
	};

	/// Celia, Bouloutas and Zarba (1990): the front at 24 h is where finite volumes of our own have it.
	TEST(Unsaturated, AWettingFrontGoesAsFarAsItMust)
	{
		Column column(40, 0.3, sand, 9.22e-5, 0.368, -10 * weight);
		column.drain(column.top(), Drain<2>::Kind::pressure, -0.75 * weight);
		column.drain(column.base(), Drain<2>::Kind::pressure, -10 * weight);
		column.run(86400, 10, 600);
		double low = 0, high = 1;
		while (high - low > 1e-6)
			(column.pressureAt((low + high) / 2) < -5 * weight ? low : high) = (low + high) / 2;
		EXPECT_NEAR((1 - low) / (1 - 0.4349), 1, 0.02);
		const double driest = sand.saturation(-10 * weight).value;
		for (const double S : column.water.whole->saturation)
			EXPECT_GE(S, driest - 1e-9);
	}

	/// Hydrostatic suction stays as it is, at any cut of the cells.
	TEST(Unsaturated, SuctionAtRestStays)
	{
		for (const double cut : { 0.9, 0.5, 1e-3, 1e-6 }) {
			Column column(5, cut, sand, 1e-5, 0.4, 0, 1e7);
			for (std::size_t p = 0; p < column.cloud.size(); ++p)
				column.water.pressure[p] = weight * (0.3 - column.cloud.position[p][1]);
			column.drain(column.base(), Drain<2>::Kind::pressure, 0.3 * weight);
			const auto before     = column.water.pressure;
			column.water.duration = 1e5;
			// Suction holds the soil together: its stress first.
			for (int k = 0; k < 3; ++k)
				ASSERT_TRUE(column.step(1e9).converged());
			for (std::size_t p = 0; p < before.size(); ++p)
				EXPECT_NEAR(column.water.pressure[p], weight * (0.3 - column.cloud.position[p][1]), 1e-10 * weight) << cut;
		}
	}

	/// Pores that are always full, with water of no weight: as if its pressure was that over still water.
	TEST(Unsaturated, FullPoresAreThoseOfSaturatedSoil)
	{
		std::vector<double> pressures[2];
		for (const bool isWhole : { false, true }) {
			Column column(8, 0.3, sand, 1e-5, 0.4, 0, 1e6);
			column.water.pores[0].retention = nullptr;
			column.water.whole->weight.setZero();
			if (!isWhole) column.water.whole.reset();
			column.drain(column.top(), Drain<2>::Kind::pressure, 0);
			column.push(column.top(), { 0, -1e4 });
			for (int k = 0; k < 5; ++k) {
				ASSERT_TRUE(column.step(10 + 50 * k).converged());
				pressures[isWhole].insert(pressures[isWhole].end(), column.water.pressure.begin(), column.water.pressure.end());
			}
		}
		for (std::size_t i = 0; i < pressures[0].size(); ++i)
			EXPECT_NEAR(pressures[0][i], pressures[1][i], 1e-7);
	}

	/// Points move on the grid as the soil settles: their water goes with them, to the last digit.
	TEST(Unsaturated, WaterGoesWithPointsThatMove)
	{
		Column column(8, 0.3, sand, 1e-5, 0.4, -weight, 1e6);
		column.drain(column.top(), Drain<2>::Kind::rain, 1e-6);
		column.push(column.top(), { 0, -1e5 });
		column.run(5e3, 50, 500);
		EXPECT_LT(column.water.drains[0].surface.vertices[0][1], 0.93);
	}

	/// All of the rain enters where the soil takes it in; else until the surface is full, and less from then on.
	TEST(Unsaturated, RainEntersUntilTheSurfaceIsFull)
	{
		constexpr double conductivity = 1e-5, duration = 60;
		for (const double rain : { 0.3, 3. }) {
			Column column(30, 0.4, sand, conductivity, 0.4, -weight);
			column.drain(column.top(), Drain<2>::Kind::rain, rain * conductivity);
			column.drain(column.base(), Drain<2>::Kind::pressure, -weight);
			double least = rain, enters = rain;
			for (int k = 0; k < 150; ++k) {
				ASSERT_TRUE(column.step(duration).converged());
				const double before = enters;
				enters              = -column.water.drains[0].out / (duration * column.h * conductivity);
				if (before < rain * (1 - 1e-9)) {
					EXPECT_LT(enters, before) << "the switch rings, or the front jumps, at step " << k;
				}
				if (k < 3) {
					EXPECT_NEAR(enters / rain, 1, 1e-9);
				}
				least = std::min(least, enters);
			}
			EXPECT_EQ(least<0.99 * rain, rain> 1);
			EXPECT_GT(least, rain > 1 ? 0.95 : 0.299);
			EXPECT_LE(column.pressureAt(0.95), rain > 1 ? 1 : -100);
		}
	}

	/// Half as much rain as soil conducts when it is full, on silt so dry that it hardly conducts.
	TEST(Unsaturated, DrySoilTakesInRainAtAnyCutOfTheCells)
	{
		const Retention  silt { Retention::Curve::vanGenuchten, Retention::Permeability::mualem, 1 / weight, 1.8, 0.15, 1 };
		constexpr double conductivity = 5e-6, duration = 1800;
		for (const auto& [cut, outside] :
		     { std::pair(0., 0.), { 0.9, 0 }, { 0.7, 0 }, { 0.5, 0 }, { 0.3, 0 }, { 0.1, 0 }, { 0.02, 0 }, { 1e-3, 0 }, { 1e-6, 0 }, { 0, 0.2 } }) {
			Column       column(10, cut, silt, conductivity, 0.42, -8 * weight);
			const double top = 1 + outside * column.h;
			column.drain(line({ column.h, top }, { 0, top }), Drain<2>::Kind::rain, 0.5 * conductivity);
			for (int k = 0; k < 8; ++k) {
				ASSERT_TRUE(column.step(duration).converged()) << cut;
				ASSERT_NEAR(-column.water.drains[0].out / (0.5 * conductivity * duration * column.h), 1, 1e-9) << cut << " step " << k;
			}
		}
	}

	/// Water evaporates at the rate that is asked for until the surface is as dry as the air, and then less.
	TEST(Unsaturated, WaterEvaporatesUntilTheSurfaceIsDry)
	{
		Column column(20, 0.4, sand, 1e-6, 0.4, -weight / 2);
		column.drain(column.top(), Drain<2>::Kind::rain, -1e-7).driest = -20 * weight;
		ASSERT_TRUE(column.step(1e3).converged());
		EXPECT_NEAR(column.water.drains[0].out / (1e3 * column.h), 1e-7, 1e-14);
		column.run(6e5, 1e3, 2e4);
		EXPECT_GT(column.water.drains[0].out, 0);
		EXPECT_LT(column.water.drains[0].out, 0.5e-7 * column.water.duration * column.h);
		EXPECT_GE(column.pressureAt(0.98), -20 * weight);
	}

} // namespace
} // namespace gimpm::testUnsaturated
