// SPDX-License-Identifier: GPL-2.0-or-later
// Law with a variable and a failure of its own in the core: its header and one entry of
// core/materials/law.hpp. The core is compiled with an entry for Remembering here.
#include "core/stepping/step_system.hpp"
#include "remembering.hpp"
#include "scenes.hpp"
#include <Eigen/LU>

namespace gimpm {
namespace {

	constexpr double E = 1e6, initial = 2e3;

	template <class Dimension> class NewLaw : public ::testing::Test {
	public:
		static constexpr int Dim = Dimension::value;

		Model<Dim> model;
		// 9 or 27 points a cell: other batches than cells.
		PointCloud<Dim> cloud = block<Dim>(model.grid, cellsOf<Dim>(2, 2, 2), 3);
		LinearSolver    solver;

		/// Every third point is elastic, every third yields.
		NewLaw()
		{
			model.materials = { { Remembering(E, initial, 5e4), 1e3 }, { Hencky(E, 0), 1e3 }, { VonMises(E, 0, 4e3), 1e3 } };
			for (std::size_t p = 0; p < cloud.size(); ++p)
				cloud.material[p] = p % 3;
		}
		/// Compresses the block between two plates, along y.
		StepReport press(double displacement)
		{
			Vec<Dim> top = Vec<Dim>::Constant(-infinity), all = Vec<Dim>::Constant(infinity);
			top[1] = 2;
			std::vector<ConstrainedBox<Dim>> boxes { wallBelow<Dim>(model.grid, 1, 0),
				                                 held<Dim>(model.grid, top, all, "y", -displacement * Vec<Dim>::Unit(1)) };
			for (int axis = 0; axis < Dim; ++axis)
				if (axis != 1) boxes.push_back(wallBelow<Dim>(model.grid, axis, 0));
			model.boundary = Boundary<Dim>(boxes);
			return loadStep(cloud, model, Load<Dim>(), solver);
		}
		const std::vector<double>& column(const char* name) const { return cloud.internals[internalVariables.find(name)]; }
		double                     pressure(std::size_t p) const // Kirchhoff
		{
			return -cloud.stress[p].full().trace() / 3 * cloud.defGrad[p].determinant();
		}
	};
	TYPED_TEST_SUITE(NewLaw, BothDimensions, DimensionName);

	TYPED_TEST(NewLaw, HasAColumnOfItsOwnBesideThatOfAnotherLaw)
	{
		ASSERT_TRUE(this->press(0.02).converged());
		std::vector<double> largest(this->cloud.size());
		int                 grown = 0, yielded = 0;
		for (std::size_t p = 0; p < this->cloud.size(); ++p) {
			if (this->cloud.material[p] == 0) {
				largest[p] = std::max(initial, this->pressure(p));
				grown += largest[p] > initial;
				EXPECT_NEAR(this->column("largestPressure")[p], largest[p], 1e-9 * initial);
			}
			yielded += this->column("plasticStrain")[p] > 0;
			EXPECT_TRUE(this->column("plasticStrain")[p] == 0 || this->cloud.material[p] == 2);
		}
		EXPECT_GT(grown, 10);
		EXPECT_GT(yielded, 10);
		ASSERT_TRUE(this->press(-0.02).converged()); // unloading: it remembers
		for (std::size_t p = 0; p < this->cloud.size(); ++p)
			if (this->cloud.material[p] == 0) {
				EXPECT_NEAR(this->column("largestPressure")[p], largest[p], 1e-9 * initial);
			}
	}

	TYPED_TEST(NewLaw, CostsNothingWhereNoPointHasIt)
	{
		this->model.materials = { { Hencky(E, 0), 1e3 }, { Hencky(E, 0), 1e3 }, { Hencky(2 * E, 0), 1e3 } };
		ASSERT_TRUE(this->press(0.02).converged());
		EXPECT_TRUE(this->column("largestPressure").empty());
		EXPECT_TRUE(this->column("plasticStrain").empty());
	}

	TYPED_TEST(NewLaw, FailsWithAPointAndAReason)
	{
		ASSERT_TRUE(this->press(0.01).converged());
		const auto       before = this->column("largestPressure");
		const StepReport report = this->press(0.5);
		EXPECT_EQ(report.failure, Failure::noResponse);
		ASSERT_GE(report.failedPoint, 0);
		EXPECT_EQ(this->cloud.material[report.failedPoint], 0);
		EXPECT_NE(report.cause.find("no stress"), std::string::npos) << report.cause;
		EXPECT_EQ(this->column("largestPressure"), before);
	}

	// The ghost stiffness goes with the modulus that the law has at the start of the step.
	TYPED_TEST(NewLaw, SaysItsModulusForItsState)
	{
		constexpr int Dim = TypeParam::value;
		std::fill(this->cloud.material.begin(), this->cloud.material.end(), 0);
		StepReport            report;
		const StepSystem<Dim> initialSystem(this->cloud, this->model, Load<Dim>(), report);
		provideInternals(this->cloud.internals, this->model.materials, this->cloud.size());
		for (double& value : this->cloud.internals[internalVariables.find("largestPressure")])
			value = 3 * initial;
		const StepSystem<Dim> system(this->cloud, this->model, Load<Dim>(), report);
		ASSERT_FALSE(system.faces.empty());
		EXPECT_NEAR(system.faces[0].stiffness, 3 * initialSystem.faces[0].stiffness, 1e-9 * system.faces[0].stiffness);
	}

} // namespace
} // namespace gimpm
