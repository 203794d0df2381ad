// SPDX-License-Identifier: GPL-2.0-or-later
// Load steps with laws whose stiffness is not symmetric: Newton's method stays quadratic, with LU and with GMRES.
#include "core/stepping/step_system.hpp"
#include "scenes.hpp"
#include <cstdio>

namespace gimpm::testSoilSteps {
namespace {

	constexpr double degree = 0.017453292519943295;

	/// A block between walls below and at the left, whose upper face moves, or under its weight.
	template <int Dim> struct Block {
		Model<Dim>      model;
		PointCloud<Dim> cloud;
		LinearSolver    solver;
		Load<Dim>       load;
		StepReport      report;

		explicit Block(const Law& law)
		{
			model.grid.cellSize    = 1;
			model.materials        = { { law, 1e3 } };
			model.newton.tolerance = 1e-10;
			cloud                  = block<Dim>(model.grid, Index<Dim>::Constant(Dim == 2 ? 4 : 3), 2);
		}
		void hold(bool isPressed)
		{
			const double                     top = Dim == 2 ? 4 : 3;
			std::vector<ConstrainedBox<Dim>> boxes { held<Dim>(model.grid, Vec<Dim>::Constant(-infinity), upTo(1, 0), Dim == 2 ? "xy" : "xyz") };
			if (isPressed) {
				Vec<Dim> min = Vec<Dim>::Constant(-infinity), moved = Vec<Dim>::Zero();
				min[1] = top, moved[0] = 0.01, moved[1] = -0.02;
				boxes.push_back(held<Dim>(model.grid, min, Vec<Dim>::Constant(infinity), "xy", moved));
			}
			for (int axis = 0; axis < Dim; ++axis)
				if (axis != 1)
					for (const auto& side : { std::pair { Vec<Dim>(Vec<Dim>::Constant(-infinity)), upTo(axis, 0) },
					                          std::pair { Vec<Dim>(-upTo(axis, -top)), Vec<Dim>(Vec<Dim>::Constant(infinity)) } }) {
						// a free face.
						if (!isPressed && axis == 0 && side.first[0] == top) continue;
						boxes.push_back(inside(side.first, side.second, axis, top));
					}
			model.boundary = Boundary<Dim>(boxes);
		}
		static Vec<Dim> upTo(int axis, double place)
		{
			Vec<Dim> max = Vec<Dim>::Constant(infinity);
			max[axis]    = place;
			return max;
		}
		/// A wall without the rows of nodes that floor and plate hold.
		ConstrainedBox<Dim> inside(Vec<Dim> min, Vec<Dim> max, int axis, double top) const
		{
			min[1] = 1, max[1] = top - 1;
			return held<Dim>(model.grid, min, max, std::string(1, "xyz"[axis]));
		}
		StepReport step(LinearMethod method)
		{
			model.newton.linearSolver = method;
			const auto report         = loadStep(cloud, model, load, solver);
			std::printf("%s, %d unknowns in %dD:", method == LinearMethod::direct ? "LU" : "GMRES", report.dofs, Dim);
			for (const double r : report.residuals)
				std::printf(" %.1e", r);
			std::printf("\n");
			return report;
		}
	};

	template <int Dim> void expectQuadratic(const Law& law, bool isPressed)
	{
		std::vector<Vec<Dim>> positions;
		for (const LinearMethod method : { LinearMethod::direct, LinearMethod::iterative }) {
			Block<Dim> body(law);
			body.hold(isPressed);
			if (!isPressed) body.load.gravity = -10 * Vec<Dim>::Unit(1);
			const StepReport report = body.step(method);
			ASSERT_TRUE(report.converged()) << report.cause;
			EXPECT_GT(convergenceOrder(report.residuals, 1e-10), 1.5);
			EXPECT_EQ(report.luSolves > 0, method == LinearMethod::direct);
			for (std::size_t p = 0; p < positions.size(); ++p)
				EXPECT_LT((body.cloud.position[p] - positions[p]).norm(), 1e-8);
			positions = body.cloud.position;
			EXPECT_GT(*std::max_element(body.cloud.internals[0].begin(), body.cloud.internals[0].end()), 1e-4);
		}
	}

	template <class Dimension> using SoilSteps = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(SoilSteps, BothDimensions, DimensionName);

	TYPED_TEST(SoilSteps, FrictionWithoutDilation)
	{
		constexpr int Dim = TypeParam::value;
		expectQuadratic<Dim>(MohrCoulomb(1e6, 0.3, Dim == 2 ? 5e3 : 3e3, 30 * degree, 0), false);
		expectQuadratic<Dim>(DruckerPrager(1e6, 0.3, DruckerPragerCone::planeStrain(Dim == 2 ? 5e3 : 3e3, 30 * degree, 0)), false);
	}

	TYPED_TEST(SoilSteps, CamClay) { expectQuadratic<TypeParam::value>(CamClay(3e6, 1.2, 0.1, 0.02, 6e4, 5e4), true); }

	// Symmetric laws, also beside others, pay for no second triangle; one that is not makes the whole model
	// unsymmetric.
	TYPED_TEST(SoilSteps, StiffnessIsAsSymmetricAsTheLaws)
	{
		constexpr int Dim       = TypeParam::value;
		const auto    symmetric = [](const std::vector<Law>& laws) {
                        Block<Dim> body(laws[0]);
                        for (std::size_t i = 1; i < laws.size(); ++i)
                                body.model.materials.push_back({ laws[i], 1 });
                        StepReport            report;
                        const StepSystem<Dim> system(body.cloud, body.model, Load<Dim>(), report);
                        return system.isSymmetric();
		};
		const Law associated = MohrCoulomb(1e6, 0.3, 8e3, 0.5, 0.5), loose = MohrCoulomb(1e6, 0.3, 8e3, 0.5, 0.4);
		EXPECT_TRUE(symmetric({ Hencky(1, 0), VonMises(1, 0, 1), associated, MohrCoulomb::tresca(1, 0, 1) }));
		EXPECT_FALSE(symmetric({ Hencky(1, 0), loose, associated }));
		EXPECT_FALSE(symmetric({ CamClay(1, 1, 0.2, 0.1, 1, 1), Hencky(1, 0) }));
	}

} // namespace
} // namespace gimpm::testSoilSteps
