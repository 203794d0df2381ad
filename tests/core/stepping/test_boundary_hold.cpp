// SPDX-License-Identifier: GPL-2.0-or-later
// A box that moves nodes is named when they hold no soil, or when a gap has opened between them and the soil that they
// push.
#include "core/stepping/lost_constraint.hpp"
#include "scenes.hpp"

namespace gimpm::testGrip {
namespace {

	/// A block of 3 cells a side, from (1, 1) to (2.5, 2.5), whose top is moved by a plate of nodes.
	template <class Dimension> class ConstrainedPiece : public ::testing::Test {
	public:
		static constexpr int Dim = Dimension::value;

		Model<Dim>      model;
		PointCloud<Dim> cloud;
		Load<Dim>       load;
		LinearSolver    solver;

		ConstrainedPiece()
		{
			model.grid      = { 0.5, Vec<Dim>::Ones() };
			model.materials = { { Hencky(1e6, 0.25), 1 } };
			cloud           = block<Dim>(model.grid, Index<Dim>::Constant(3), 2);
			cloud.position0 = cloud.position;
			plate(-Vec<Dim>::Unit(1));
		}
		/// Nodes at y = height are moved.
		void plate(const Vec<Dim>& by, double height = 2.5)
		{
			Vec<Dim> min = Vec<Dim>::Constant(-infinity), max = Vec<Dim>::Constant(infinity);
			min[1] = max[1] = height;
			std::vector<ConstrainedBox<Dim>> boxes { held<Dim>(model.grid, min, max, Dim == 2 ? "xy" : "xyz", by) };
			for (int axis = 0; axis < Dim; ++axis)
				boxes.push_back(wallBelow<Dim>(model.grid, axis, 1));
			model.boundary = Boundary<Dim>(boxes);
		}
		/// The soil within (less than) two cells of its top is moved down, by a number of cells.
		void lower(double cells)
		{
			for (auto& x : cloud.position)
				if (x[1] > 1.5) x[1] -= cells * model.grid.cellSize;
		}
		std::string lost() const { return lostConstraint<Dim>(cloud, cloudBasis<Dim>(cloud, model.grid, model.basis, model.boundary), model, load); }
	};
	TYPED_TEST_SUITE(ConstrainedPiece, BothDimensions, DimensionName);

	TYPED_TEST(ConstrainedPiece, IsLostWhenMoreThanHalfACellHasOpened)
	{
		EXPECT_EQ(this->lost(), "");
		this->lower(0.5);
		EXPECT_EQ(this->lost(), "");
		this->lower(0.01);
		const std::string lost = this->lost();
		EXPECT_EQ(lost.rfind("boundaries[0] moves by (0, -1", 0), 0u) << lost;
		EXPECT_NE(lost.find("along -y is 0.51 cells away from its node at (1, 2.5"), std::string::npos) << lost;
	}

	TYPED_TEST(ConstrainedPiece, IsLostAlsoWhereTheNodesCarryNoSoilAnyMore)
	{
		// one column of points stays: the other nodes are still missed
		const double edge = 1.25;
		for (auto& x : this->cloud.position)
			if (x[0] > edge) x[1] -= 1.2 * this->model.grid.cellSize;
		EXPECT_NE(this->lost().find("1.2 cells away"), std::string::npos) << this->lost();
	}

	TYPED_TEST(ConstrainedPiece, IsNotOfSoilThatWasNeverThere)
	{
		this->cloud.position0.clear();
		this->lower(0.75);
		EXPECT_EQ(this->lost(), "");
		this->cloud.position0 = this->cloud.position;
		this->lower(0.2);
		EXPECT_EQ(this->lost(), "") << "0.2 cells further than at first";
		this->lower(0.1);
		EXPECT_NE(this->lost(), "");
	}

	TYPED_TEST(ConstrainedPiece, DependsOnTheDirection)
	{
		constexpr int Dim = TypeParam::value;
		this->lower(0.6);
		for (const Vec<Dim>& by : { Vec<Dim>(Vec<Dim>::Unit(1)), Vec<Dim>(Vec<Dim>::Unit(0)), Vec<Dim>(-Vec<Dim>::Unit(0)) }) {
			this->plate(by);
			EXPECT_EQ(this->lost(), "") << by.transpose();
		}
		this->load.factor = { -0.1, -0.1 };
		this->plate(Vec<Dim>::Unit(1));
		EXPECT_NE(this->lost(), "") << "a negative factor turns it round";
		this->load.factor = { -0.1, 0.1 };
		EXPECT_NE(this->lost(), "") << "on the way back";
		this->load.factor = { -0.1, 0 };
		EXPECT_NE(this->lost(), "") << "at rest";
		this->load.factor.value = 0;
		EXPECT_EQ(this->lost(), "") << "before it has begun";
	}

	TYPED_TEST(ConstrainedPiece, IsKeptByNodesInsideOfTheSoil)
	{
		constexpr int Dim = TypeParam::value;
		this->plate(-Vec<Dim>::Unit(1), 2);
		this->lower(0.9);
		EXPECT_EQ(this->lost(), "");
		this->lower(0.7); // the top has passed the nodes by 0.6 cells
		EXPECT_NE(this->lost(), "");
	}

	TYPED_TEST(ConstrainedPiece, NeedsANodeWithSoil)
	{
		constexpr int Dim = TypeParam::value;
		this->plate(-Vec<Dim>::Unit(1), 3.5);
		this->load.factor      = { 0, 0 };
		const std::string lost = this->lost();
		EXPECT_NE(lost.find("none of its nodes, from (-inf, 3.5"), std::string::npos) << lost;
		EXPECT_NE(lost.find("between (1, 1"), std::string::npos) << lost;
		this->plate(Vec<Dim>::Zero(), 3.5);
		EXPECT_EQ(this->lost(), "") << "a box that holds nodes may wait for soil";
	}

	TYPED_TEST(ConstrainedPiece, LostEndsTheStep)
	{
		this->lower(0.6);
		const auto before = this->cloud.position;
		const auto report = loadStep(this->cloud, this->model, this->load, this->solver);
		EXPECT_EQ(report.failure, Failure::detached);
		EXPECT_EQ(report.iterations, 0);
		EXPECT_EQ(report.cause, this->lost());
		EXPECT_EQ(this->cloud.position, before);
	}

} // namespace
} // namespace gimpm::testGrip
