// SPDX-License-Identifier: GPL-2.0-or-later
// Water in the pores and around a body: averages of pressure, tangents, and balances by hand.
#include "core/terms/water/water.hpp"
#include "derivatives.hpp"
#include "scenes.hpp"

namespace gimpm::testWater {
namespace {

	constexpr double weight = 1e4;

	/// Nodes from -3 to 8 along each axis with these pressures.
	template <int Dim, class F> std::shared_ptr<WaterPressure<Dim>> table(const Grid<Dim>& grid, F&& pressure, const Vec<Dim>& fall = Vec<Dim>::Zero())
	{
		std::vector<Key>    nodes;
		std::vector<double> values;
		forIndices<Dim>(Index<Dim>::Constant(-3), Index<Dim>::Constant(12), [&](const Index<Dim>& node) {
			nodes.push_back(Grid<Dim>::key(node));
			values.push_back(pressure(grid.nodePosition(node)));
		});
		return std::make_shared<TabulatedWater<Dim>>(grid, nodes, values, fall);
	}

	/// Three cells of 0.5 m a side, of mass density 2000, in water.
	template <int Dim> struct Block {
		Model<Dim>      model;
		PointCloud<Dim> cloud;
		Water<Dim>      water;
		StepReport      report;
		LinearSolver    solver;

		explicit Block(WaterDomain place, double level = 5, int perAxis = 2)
		{
			model.grid.cellSize    = 0.5;
			model.materials        = { { Hencky(1e6, 0), 2000 } };
			model.newton.tolerance = 1e-11;
			model.terms            = { [this](const StepContext<Dim>& step) { return std::make_unique<WaterForce<Dim>>(water, step); } };
			water.domain           = place;
			water.pressure = water.before = std::make_shared<StillWater<Dim>>(1, 1, level, weight);
			cloud                         = block<Dim>(model.grid, Index<Dim>::Constant(3), perAxis);
		}
		void rollers()
		{
			std::vector<ConstrainedBox<Dim>> walls;
			for (int a = 0; a < Dim; ++a)
				walls.push_back(wallBelow<Dim>(model.grid, a, 0));
			for (int a = 0; a < Dim; ++a)
				if (a != 1) walls.push_back(wallAbove<Dim>(model.grid, a, 1.5));
			model.boundary = Boundary<Dim>(walls);
		}
		StepReport      step(double gravity) { return loadStep<Dim>(cloud, model, { -gravity * Vec<Dim>::Unit(1) }, solver); }
		StepSystem<Dim> system() { return { cloud, model, Load<Dim>(), report }; }

		/// Resultant of the water on the body.
		Vec<Dim> resultant() { return resultantBefore<Dim>(system()); }
	};

	template <class T> using WaterOf = InBothDimensions<T>;
	TYPED_TEST_SUITE(WaterOf, BothDimensions, DimensionName);

	template <int Dim> Vec<Dim> wavy(const Vec<Dim>& x) { return (1.3 * x).array().sin() + 0.2; }

	TYPED_TEST(WaterOf, AveragesHaveTheirDerivatives)
	{
		constexpr int Dim = TypeParam::value;
		Grid<Dim>     grid;
		grid.cellSize                                    = 0.5;
		const auto                                     t = table<Dim>(grid, [](const Vec<Dim>& x) { return 100 * wavy<Dim>(x).prod(); });
		const StillWater<Dim>                          still(1, 1, 0.7, weight);
		Random                                         random(5);
		const Vec<Dim>                                 half = Vec<Dim>::Constant(0.19);
		const std::array<const WaterPressure<Dim>*, 2> both { t.get(), &still };
		for (const auto* water : both)
			for (int trial = 0; trial < 20; ++trial) {
				const Vec<Dim> x = Vec<Dim>::Constant(0.75) + random.vector(Dim, 0.5);
				const auto     p = *water->around(x, half);
				for (int a = 0; a < Dim; ++a) {
					const double   e     = 1e-6;
					const Vec<Dim> step  = e * Vec<Dim>::Unit(a);
					const auto     after = *water->around(x + step, half), before = *water->around(x - step, half);
					EXPECT_NEAR((after.value - before.value) / (2 * e), p.gradient[a], 1e-4 * weight);
					EXPECT_LT(((after.gradient - before.gradient) / (2 * e) - p.hessian.col(a)).norm(), 1e-4 * weight) << x.transpose();
				}
			}
	}

	TYPED_TEST(WaterOf, TablesOfLinearPressureAreExactAndEndWhereNothingIsKnown)
	{
		constexpr int Dim = TypeParam::value;
		Grid<Dim>     grid;
		grid.cellSize    = 0.5;
		const auto     t = table<Dim>(grid, [](const Vec<Dim>& x) { return 3e3 - 7e3 * x[0] + 1e3 * x[1]; });
		const Vec<Dim> x = Vec<Dim>::Constant(0.63), half = Vec<Dim>::Constant(0.25);
		const auto     p = *t->around(x, half);
		Vec<Dim>       g = Vec<Dim>::Zero();
		g[0] = -7e3, g[1] = 1e3;
		EXPECT_NEAR(p.value, 3e3 - 6e3 * 0.63, 1e-8);
		EXPECT_LT((p.gradient - g).norm(), 1e-8);
		EXPECT_LT(p.hessian.norm(), 1e-7);
		EXPECT_FALSE(t->around(Vec<Dim>::Constant(4.2), half));
		EXPECT_FALSE(t->around(Vec<Dim>::Constant(1e300), half));
	}

	TYPED_TEST(WaterOf, TangentIsTheDerivative)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto place : { WaterDomain::everywhere, WaterDomain::pores, WaterDomain::outside }) {
			Block<Dim> block(place, 5, 1);
			block.water.pressure = table<Dim>(block.model.grid, [](const Vec<Dim>& x) { return 100 * wavy<Dim>(x).prod(); });
			block.water.factor   = 1.7;
			EXPECT_LT(tangentErrorOfLastTerm(block.system(), block.model.grid, 1e-5), 1e-7) << int(place);
			EXPECT_EQ(block.system().isSymmetric(), place != WaterDomain::pores);
		}
	}

	TEST(Water, OfRingsHasItsTangent)
	{
		for (const auto place : { WaterDomain::everywhere, WaterDomain::pores, WaterDomain::outside }) {
			Block<2> block(place);
			block.model.grid.axisymmetric = true;
			block.cloud.hoopStretch.assign(block.cloud.size(), 1.1);
			block.water.pressure = table<2>(block.model.grid, [](const Vec<2>& x) { return 100 * wavy<2>(x).prod(); });
			EXPECT_LT(tangentErrorOfLastTerm(block.system(), block.model.grid, 1e-5), 1e-7) << int(place);
		}
	}

	TYPED_TEST(WaterOf, ThatFallsAlongThePeriodDragsTheBodyByTheForceInItsPores)
	{
		constexpr int Dim   = TypeParam::value;
		const double  slope = 7e3, volume = std::pow(1.5, Dim);
		for (const auto place : { WaterDomain::everywhere, WaterDomain::pores, WaterDomain::outside }) {
			Block<Dim> block(place);
			block.model.grid.period[0] = 3;
			for (auto& x : block.cloud.position)
				x[0] += 0.3; // some reach over the far side
			const Vec<Dim> fall = -slope * 1.5 * Vec<Dim>::Unit(0);
			const auto     wave = [](const Vec<Dim>& x) {
                                return 400 * std::sin(2 * M_PI * x[0] / 1.5) * x[1];
			}; // so that the gradient is not the same everywhere
			const auto p = table<Dim>(
			        block.model.grid, [&](const Vec<Dim>& x) { return 3e4 - slope * x[0] + 1e3 * x[1] + wave(x); }, fall);
			block.water.pressure = block.water.before = p;
			const bool isInPores                      = place != WaterDomain::outside;
			EXPECT_NEAR(block.resultant()[0], isInPores ? slope * volume : 0, 1e-9 * slope) << int(place);
			EXPECT_LT(tangentErrorOfLastTerm(block.system(), block.model.grid, 1e-5), 1e-7) << int(place);
			EXPECT_EQ(block.system().isSymmetric(), place == WaterDomain::everywhere) << int(place);
		}
	}

	TYPED_TEST(WaterOf, ActsInPartOnWhatIsThereInPart)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto place : { WaterDomain::everywhere, WaterDomain::outside }) {
			Block<Dim> block(place);
			const auto whole   = block.resultant();
			block.water.shares = { 0.25 };
			EXPECT_LT((block.resultant() - 0.25 * whole).norm(), 1e-12 * whole.norm());
			EXPECT_GT(whole.norm(), 0.1 * weight);
		}
	}

	TYPED_TEST(WaterOf, LiftsByTheWeightOfTheWaterInItsPlace)
	{
		constexpr int Dim  = TypeParam::value;
		const double  area = std::pow(1.5, Dim - 1);
		for (const auto place : { WaterDomain::everywhere, WaterDomain::outside })
			for (const double level : { 5., 1.5, 0.6, 0.333 })
				EXPECT_LT(
				        (Block<Dim>(place, level).resultant() - weight * area * std::min(level, 1.5) * Vec<Dim>::Unit(1)).norm(), 1e-9 * weight)
				        << level;
	}

	TYPED_TEST(WaterOf, InPoresAndAroundActsAsTheTwoByThemselves)
	{
		constexpr int         Dim    = TypeParam::value;
		const Eigen::VectorXd d      = Eigen::VectorXd::Zero(Block<Dim>(WaterDomain::pores).system().nodalSize());
		const auto            forces = [&](WaterDomain place) {
                        Block<Dim>      block(place, 1.1);
                        Eigen::VectorXd f = d;
                        block.system().terms.back()->add(d, { f });
                        return f;
		};
		EXPECT_LT((forces(WaterDomain::pores) + forces(WaterDomain::outside) - forces(WaterDomain::everywhere)).norm(), 1e-10 * weight);
	}

	TYPED_TEST(WaterOf, SubmergedSoilIsAsSoilOfItsSubmergedDensity)
	{
		constexpr int Dim = TypeParam::value;
		Block<Dim>    wet(WaterDomain::everywhere), light(WaterDomain::everywhere);
		light.model.materials[0].density = 1000;
		light.model.terms.clear();
		for (auto* block : { &wet, &light }) {
			block->rollers();
			EXPECT_TRUE(block->step(10).converged());
		}
		EXPECT_GT((wet.cloud.position.back() - block<Dim>(wet.model.grid, Index<Dim>::Constant(3), 2).position.back()).norm(), 0.005);
		for (std::size_t p = 0; p < wet.cloud.size(); ++p)
			EXPECT_LT((wet.cloud.position[p] - light.cloud.position[p]).norm(), 1e-11);
		// Load of the floor: the pressure of the water there; of the sides: half of it.
		double floor = 0, side = 0;
		for (const auto& [node, force] : wet.water.onWalls) {
			floor += force[1];
			if (Grid<Dim>::index(node)[0] == 0) side += force[0];
		}
		const double area = std::pow(1.5, Dim - 2), height = wet.cloud.position.back()[1] + wet.cloud.halfSize.back()[1];
		EXPECT_NEAR(floor / (1.5 * area * 5 * weight), 1, 1e-6);
		EXPECT_NEAR(side / (area * weight * (5 * height - height * height / 2)), 1, 1e-3);
		EXPECT_NEAR(wet.water.porePressure[0], weight * (5 - wet.cloud.position[0][1]), 1e-9 * weight);
	}

	/// An even pressure around a body that fills no pores: its stress.
	TYPED_TEST(WaterOf, OutsidePressesAsASurfaceLoad)
	{
		constexpr int Dim = TypeParam::value;
		Block<Dim>    block(WaterDomain::outside);
		block.water.pressure = table<Dim>(block.model.grid, [](const Vec<Dim>&) { return 2e4; });
		block.water.before   = block.water.pressure;
		std::vector<ConstrainedBox<Dim>> walls;
		for (int a = 0; a < Dim; ++a)
			walls.push_back(wallBelow<Dim>(block.model.grid, a, 0));
		block.model.boundary = Boundary<Dim>(walls);
		EXPECT_TRUE(block.step(0).converged());
		for (const auto& stress : block.cloud.stress) {
			EXPECT_NEAR(stress.c[0], -2e4, 1e-5);
			EXPECT_NEAR(stress.c[1], -2e4, 1e-5);
		}
	}

	TEST(Water, ThatIsNotKnownFailsThePoint)
	{
		Block<2> block(WaterDomain::everywhere);
		block.water.pressure         = std::make_shared<TabulatedWater<2>>(block.model.grid, std::vector<Key> {}, std::vector<double> {});
		const auto            system = block.system();
		const Eigen::VectorXd d      = Eigen::VectorXd::Zero(system.nodalSize());
		Eigen::VectorXd       force  = d;
		const auto            failed = system.terms.back()->add(d, { force });
		ASSERT_TRUE(failed);
		EXPECT_EQ(failed->point, 0);
	}
} // namespace
} // namespace gimpm::testWater
