// SPDX-License-Identifier: GPL-2.0-or-later
// Load steps driven by prescribed displacements of nodes.
#include "scenes.hpp"

namespace gimpm {
namespace {

	template <class Dimension> class PrescribedDisplacement : public ::testing::Test {
	public:
		static constexpr int Dim = Dimension::value;

		Model<Dim>      model;
		PointCloud<Dim> cloud;
		LinearSolver    solver;

		/// A block of 2 cells a side on rollers (nu = 0), whose top (y = 2) is moved along y.
		PrescribedDisplacement() : cloud(block<Dim>(model.grid, Index<Dim>::Constant(2), 2))
		{
			model.materials        = { { Hencky(1e6, 0), 1 } };
			model.newton.tolerance = 1e-12;
		}
		void move(double displacement)
		{
			Vec<Dim> min = Vec<Dim>::Constant(-infinity);
			min[1]       = 2;
			std::vector<ConstrainedBox<Dim>> boxes { held<Dim>(
				model.grid, min, Vec<Dim>::Constant(infinity), "y", displacement * Vec<Dim>::Unit(1)) };
			for (int axis = 0; axis < Dim; ++axis)
				boxes.push_back(wallBelow<Dim>(model.grid, axis, 0));
			model.boundary = Boundary<Dim>(boxes);
		}
	};
	TYPED_TEST_SUITE(PrescribedDisplacement, BothDimensions, DimensionName);

	TYPED_TEST(PrescribedDisplacement, AloneItIsFullyApplied)
	{
		// uniaxial stress with nu = 0: strain log(lambda), Kirchhoff stress E log(lambda), J = lambda
		for (const double displacement : { -0.5, -1e-3, 1e-9, 0.5 }) {
			auto cloud = this->cloud;
			this->move(displacement);
			const auto report = loadStep(cloud, this->model, {}, this->solver);
			ASSERT_TRUE(report.converged()) << report.cause;
			EXPECT_EQ(report.residuals.front(), 0);
			EXPECT_GE(report.iterations, 1);
			const double strain = std::log1p(displacement / 2), lambda = 1 + displacement / 2;
			for (std::size_t p = 0; p < cloud.size(); ++p) {
				EXPECT_NEAR(cloud.elasticStrain[p].c[1] / strain, 1, 1e-9);
				EXPECT_NEAR(cloud.stress[p].c[1] / (1e6 * strain / lambda), 1, 1e-9);
				EXPECT_NEAR(cloud.position[p][1], this->cloud.position[p][1] * lambda, 1e-12);
				EXPECT_NEAR(cloud.position[p][0], this->cloud.position[p][0], 1e-12);
			}
		}
	}

	TYPED_TEST(PrescribedDisplacement, AStepAppliesItsShareOfTheTotal)
	{
		constexpr int Dim = TypeParam::value;
		this->move(-0.4);
		Load<Dim> load;
		load.factor.value  = 0.75;
		load.factor.growth = 0.25;
		ASSERT_TRUE(loadStep(this->cloud, this->model, load, this->solver).converged());
		for (const auto& F : this->cloud.defGrad)
			EXPECT_NEAR(F(1, 1), 1 - 0.1 / 2, 1e-12);
	}

	TYPED_TEST(PrescribedDisplacement, ItActsTogetherWithGravity)
	{
		// Gravity makes the compression uneven; its mean is what the top prescribes.
		constexpr int Dim = TypeParam::value;
		this->move(-0.2);
		this->model.materials[0].density = 1e3;
		Load<Dim> load;
		load.gravity = -10 * Vec<Dim>::Unit(1);
		ASSERT_TRUE(loadStep(this->cloud, this->model, load, this->solver).converged());
		double meanStretch = 0;
		for (const auto& F : this->cloud.defGrad)
			meanStretch += F(1, 1) / this->cloud.size();
		EXPECT_NEAR(meanStretch, 0.9, 1e-12);
		EXPECT_LT(this->cloud.stress[0].c[1], this->cloud.stress[this->cloud.size() - 1].c[1] - 9e3)
		        << "more compressed below, by about half the weight";
	}

	/// Turns and moves four lines of nodes in the middle of a bar, whose ends are free, in two steps: stresses must
	/// vanish.
	template <int Dim> void moveRigidly(double angle, const Vec<Dim>& by)
	{
		Model<Dim> model;
		model.materials = { { Hencky(1e6, 0.3), 1 } };
		Index<Dim> size = Index<Dim>::Constant(2);
		size[0]         = 6;
		auto     cloud  = block<Dim>(model.grid, size, 2, Index<Dim>::Constant(-1));
		Vec<Dim> centre = Vec<Dim>::Zero();
		Mat<Dim> turn   = Mat<Dim>::Identity();
		turn.template topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
		LinearSolver solver;
		for (int step = 0; step < 2; ++step) {
			std::vector<ConstrainedBox<Dim>> boxes; // no two of these lines bound a face of a cell: none is a wall
			for (const auto& [i, j] : { std::pair { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 } }) {
				Vec<Dim> low = Vec<Dim>::Constant(-infinity), high = Vec<Dim>::Constant(infinity), place = Vec<Dim>::Zero();
				low.template head<2>() = high.template head<2>() = place.template head<2>() = Eigen::Vector2d(i, j);
				boxes.push_back(held<Dim>(model.grid, low, high, Dim == 2 ? "xy" : "xyz", turn * (place - centre) + centre + by - place));
			}
			model.boundary    = Boundary<Dim>(boxes);
			const auto before = cloud.position;
			const auto report = loadStep(cloud, model, {}, solver);
			ASSERT_TRUE(report.converged()) << report.cause;
			EXPECT_LE(report.iterations, 8);
			for (std::size_t p = 0; p < cloud.size(); ++p) {
				EXPECT_LT((cloud.position[p] - (turn * (before[p] - centre) + centre + by)).norm(), 1e-5);
				EXPECT_LT(cloud.stress[p].c.norm(), 10);
			}
			centre += by;
		}
	}

	/// Held nodes within a free block take it along by half a cell, whatever domains reach past them.
	TYPED_TEST(PrescribedDisplacement, HeldNodesWithinABodyMoveAllOfIt)
	{
		constexpr int    Dim  = TypeParam::value;
		const Grid<Dim>& grid = this->model.grid;
		const Vec<Dim>   way = 0.5 * Vec<Dim>::Unit(0) + 0.25 * Vec<Dim>::Unit(1), everywhere = Vec<Dim>::Constant(infinity);
		for (const auto& [begin, end] : { std::pair(1., 1.), std::pair(-infinity, 1.), std::pair(-infinity, infinity) }) {
			auto     cloud = this->cloud;
			Vec<Dim> min = -everywhere, max = everywhere;
			min[0] = begin, max[0] = end;
			this->model.boundary = Boundary<Dim>({ held<Dim>(grid, min, max, std::string("xyz").substr(0, Dim), way) });
			for (int step = 1; step <= 5; ++step) {
				Load<Dim> load;
				load.factor = { step / 5., 1 / 5. };
				ASSERT_TRUE(loadStep(cloud, this->model, load, this->solver).converged());
			}
			for (std::size_t p = 0; p < cloud.size(); ++p) {
				EXPECT_LT((cloud.position[p] - this->cloud.position[p] - way).norm(), 1e-9) << end;
				EXPECT_LT(cloud.stress[p].c.norm(), 1e-3) << end; // E = 1e6
			}
		}
	}

	TYPED_TEST(PrescribedDisplacement, RigidMotionsConverge)
	{
		constexpr int Dim = TypeParam::value;
		moveRigidly<Dim>(0.2, Vec<Dim>::Zero());
		moveRigidly<Dim>(-1e-3, 0.01 * Vec<Dim>::Ones());
		moveRigidly<Dim>(0, 0.1 * Vec<Dim>::Ones());
		moveRigidly<Dim>(0, 1e-9 * Vec<Dim>::Ones());
	}

} // namespace
} // namespace gimpm
