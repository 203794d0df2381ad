// SPDX-License-Identifier: GPL-2.0-or-later
// Degenerate scenes: each load step ends sensibly, or says what is wrong.
#include "scenes.hpp"

namespace gimpm {
namespace {

	template <class Dimension> class Extremes : public ::testing::Test {
	public:
		static constexpr int Dim = Dimension::value;

		Model<Dim>      model;
		PointCloud<Dim> cloud;
		Load<Dim>       load;
		LinearSolver    solver;

		/// A rough floor at y = 0, gravity downwards.
		Extremes()
		{
			Vec<Dim> max = Vec<Dim>::Constant(infinity);
			max[1]       = 0;
			model.materials.push_back({ Hencky(1e6, 0.3), 1e3 });
			model.boundary = Boundary<Dim>({ held<Dim>(model.grid, Vec<Dim>::Constant(-infinity), max, Dim == 2 ? "xy" : "xyz") });
			load.gravity   = -10 * Vec<Dim>::Unit(1);
		}
		StepReport step() { return loadStep(cloud, model, load, solver); }
	};
	TYPED_TEST_SUITE(Extremes, BothDimensions, DimensionName);

	TYPED_TEST(Extremes, NoPoints)
	{
		const auto report = this->step();
		EXPECT_TRUE(report.converged());
		EXPECT_EQ(report.dofs, 0);
		EXPECT_EQ(tangentStiffness(this->cloud, this->model).size(), 0);
	}

	TYPED_TEST(Extremes, OnePointHasFewerStrainsThanItsCellHasModes)
	{
		constexpr int Dim = TypeParam::value;
		for (const Vec<Dim>& x : { Vec<Dim>(Vec<Dim>::Constant(0.5)), Vec<Dim>(Vec<Dim>::Constant(0.4)) }) {
			this->cloud = PointCloud<Dim>();
			addPoint<Dim>(this->cloud, x, Vec<Dim>::Constant(0.25));
			EXPECT_EQ(this->step().failure, Failure::singular);
		}
	}

	TYPED_TEST(Extremes, ManyPointsAtOnePlaceAreNoBetter)
	{
		constexpr int Dim = TypeParam::value;
		for (int i = 0; i < 50; ++i)
			addPoint<Dim>(this->cloud, Vec<Dim>::Constant(0.5), Vec<Dim>::Constant(0.25));
		EXPECT_EQ(this->step().failure, Failure::singular);
	}

	TYPED_TEST(Extremes, AllPointsInOneCell)
	{
		constexpr int Dim = TypeParam::value;
		this->cloud       = block<Dim>(this->model.grid, Index<Dim>::Ones(), 3);
		const auto report = this->step();
		ASSERT_TRUE(report.converged()) << report.cause;
		EXPECT_EQ(report.populatedCells, 1);
		EXPECT_EQ(report.ghostFaces, 0);
		EXPECT_LT(this->cloud.position[0][1], 1. / 6);
	}

	TYPED_TEST(Extremes, DomainsOfNoSize)
	{
		// points and gimp functions of vanishing domains are those of the linear basis
		constexpr int Dim = TypeParam::value;
		this->cloud       = block<Dim>(this->model.grid, Index<Dim>::Constant(2), 2);
		auto linear       = this->cloud;
		for (std::size_t p = 0; p < linear.size(); ++p)
			this->cloud.halfSize[p] = this->cloud.halfSize0[p] = Vec<Dim>::Constant(1e-12);
		ASSERT_TRUE(this->step().converged());
		this->model.basis = Basis::linear;
		ASSERT_TRUE(loadStep(linear, this->model, this->load, this->solver).converged());
		for (std::size_t p = 0; p < linear.size(); ++p)
			EXPECT_LT((this->cloud.position[p] - linear.position[p]).norm(), 1e-14);
	}

	TYPED_TEST(Extremes, EveryNodeHeld)
	{
		constexpr int Dim    = TypeParam::value;
		this->cloud          = block<Dim>(this->model.grid, Index<Dim>::Constant(2), 2);
		const auto start     = this->cloud.position;
		const auto all       = Vec<Dim>::Constant(infinity).eval();
		this->model.boundary = Boundary<Dim>({ held<Dim>(this->model.grid, -all, all, Dim == 2 ? "xy" : "xyz") });
		const auto report    = this->step();
		EXPECT_TRUE(report.converged()) << report.cause;
		EXPECT_EQ(report.dofs, 0);
		EXPECT_TRUE(this->cloud.position == start);
	}

	TYPED_TEST(Extremes, AHingeIsAMechanism)
	{
		// a second block that touches the first in one node only
		constexpr int Dim  = TypeParam::value;
		this->cloud        = block<Dim>(this->model.grid, Index<Dim>::Constant(2), 2);
		const auto hanging = block<Dim>(this->model.grid, Index<Dim>::Constant(2), 2, Index<Dim>::Constant(2));
		for (const auto& x : hanging.position)
			addPoint<Dim>(this->cloud, x, hanging.halfSize[0]);
		EXPECT_EQ(this->step().failure, Failure::singular);
	}

	TYPED_TEST(Extremes, LoadsBeyondAllMeasure)
	{
		constexpr int Dim = TypeParam::value;
		for (const double factor : { 1e6, 1e100, 1e300 }) {
			this->cloud             = block<Dim>(this->model.grid, Index<Dim>::Constant(2), 2);
			this->load.factor.value = factor;
			const auto report       = this->step();
			EXPECT_FALSE(report.converged());
			EXPECT_FALSE(report.cause.empty());
		}
	}

	TYPED_TEST(Extremes, FarFromTheOriginRoundOffPopulatesNothing)
	{
		constexpr int Dim = TypeParam::value;
		for (const double h : { 1., 0.3 })
			for (const int shift : { 100000, Dim == 2 ? 10000000 : 250000 }) {
				this->model.grid.cellSize = h;
				this->cloud               = block<Dim>(this->model.grid, Index<Dim>::Constant(3), 3);
				for (auto& x : this->cloud.position)
					x[0] += h * shift;
				const auto report = this->step();
				ASSERT_TRUE(report.converged()) << report.cause;
				EXPECT_EQ(report.populatedCells, Dim == 2 ? 9 : 27) << h << " " << shift;
			}
	}

} // namespace
} // namespace gimpm
