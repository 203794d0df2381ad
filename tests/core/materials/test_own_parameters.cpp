// SPDX-License-Identifier: GPL-2.0-or-later
// Points with strengths and moduli of their own against materials with these.
#include "core/stepping/load_step.hpp"
#include "core/stepping/step_system.hpp"
#include "scenes.hpp"

namespace gimpm::testOwnParameters {
namespace {

	constexpr double phi = 0.5;

	/// Three laws of each kind; the parameters of a point are those of one of the three, in turn.
	std::vector<std::vector<Law>> kinds()
	{
		const auto cone = [](double c, double psi) { return DruckerPragerCone::planeStrain(c, phi, psi); };
		return {
			{ Hencky(1e6, 0.3), Hencky(2e6, 0.3), Hencky(3e5, 0.3) },
			{ VonMises(1e6, 0.3, 4e3), VonMises(1e6, 0.3, 2e3, 1e4), VonMises(2e6, 0.3, 3e3, -1e4, 1e3) },
			{ MohrCoulomb(1e6, 0.3, 2e3, phi, 0.1), MohrCoulomb(1e6, 0.3, 1e3, 0.4, 0.4), MohrCoulomb(1e6, 0.3, 3e3, phi, 0.1, 500) },
			{ DruckerPrager(1e6, 0.3, cone(2e3, 0.1)), DruckerPrager(1e6, 0.3, cone(1e3, 0.1)), DruckerPrager(2e6, 0.3, cone(3e3, 0), 500) },
		};
	}

	template <int Dim> struct Body {
		Model<Dim> model;
		// 9 or 27 points a cell: other batches than cells.
		PointCloud<Dim> cloud = block<Dim>(model.grid, cellsOf<Dim>(2, 2, 2), 3);

		StepReport press()
		{
			LinearSolver solver;
			Vec<Dim>     top = Vec<Dim>::Constant(-infinity), all = Vec<Dim>::Constant(infinity);
			top[1] = 2;
			model.boundary
			        = Boundary<Dim>({ wallBelow<Dim>(model.grid, 0, 0), wallBelow<Dim>(model.grid, 1, 0), wallBelow<Dim>(model.grid, Dim - 1, 0),
			                          held<Dim>(model.grid, top, all, "y", -0.02 * Vec<Dim>::Unit(1)) });
			return loadStep(cloud, model, Load<Dim>(), solver);
		}
	};

	template <class Dimension> class OwnParameters : public ::testing::Test {
	public:
		static constexpr int Dim = Dimension::value;

		/// The points of the first law, or an elastic one, have parameters of their own.
		static Body<Dim> withColumns(const std::vector<Law>& laws)
		{
			Body<Dim> body;
			body.model.materials = { { laws[0], 1e3, true }, { Hencky(1e6, 0.3), 1e3 } };
			body.cloud.parameters.resize(parametersOf(laws[0]).size());
			for (std::size_t p = 0; p < body.cloud.size(); ++p) {
				body.cloud.material[p] = p % 4 == 3;
				for (std::size_t k = 0; k < body.cloud.parameters.size(); ++k)
					body.cloud.parameters[k].push_back(parametersOf(laws[p % 4 % 3])[k]);
			}
			return body;
		}
		static Body<Dim> withMaterials(const std::vector<Law>& laws)
		{
			Body<Dim> body;
			body.model.materials = { { laws[0], 1e3 }, { laws[1], 1e3 }, { laws[2], 1e3 }, { Hencky(1e6, 0.3), 1e3 } };
			for (std::size_t p = 0; p < body.cloud.size(); ++p)
				body.cloud.material[p] = int(p % 4);
			return body;
		}
	};
	TYPED_TEST_SUITE(OwnParameters, BothDimensions, DimensionName);

	TYPED_TEST(OwnParameters, ActAsMaterialsWithThem)
	{
		for (const auto& laws : kinds()) {
			auto       ours = this->withColumns(laws), theirs = this->withMaterials(laws);
			const auto r = ours.press(), s = theirs.press();
			ASSERT_TRUE(r.converged() && s.converged());
			EXPECT_EQ(r.iterations, s.iterations);
			EXPECT_NEAR(r.residuals[0], s.residuals[0], 1e-10); // the reference of convergence
			double size = 0, difference = 0;
			for (std::size_t p = 0; p < ours.cloud.size(); ++p) {
				size       = std::max(size, theirs.cloud.stress[p].c.norm());
				difference = std::max(difference, (ours.cloud.stress[p].c - theirs.cloud.stress[p].c).norm());
			}
			EXPECT_LT(difference, 1e-10 * size);
		}
	}

	TYPED_TEST(OwnParameters, GoIntoTheGhostStiffnessAndTheSymmetry)
	{
		constexpr int Dim = TypeParam::value;
		for (const auto& laws : kinds()) {
			const auto            ours = this->withColumns(laws), theirs = this->withMaterials(laws);
			StepReport            report;
			const StepSystem<Dim> a(ours.cloud, ours.model, Load<Dim>(), report), b(theirs.cloud, theirs.model, Load<Dim>(), report);
			ASSERT_EQ(a.faces.size(), b.faces.size());
			ASSERT_FALSE(a.faces.empty());
			for (std::size_t f = 0; f < a.faces.size(); ++f)
				EXPECT_NEAR(a.faces[f].stiffness, b.faces[f].stiffness, 1e-12 * b.faces[f].stiffness);
			EXPECT_EQ(a.isSymmetric(), b.isSymmetric());
		}
		// the material is associated, one of its points is not
		Body<Dim> body;
		body.model.materials  = { { MohrCoulomb(1e6, 0.3, 2e3, phi, phi), 1e3, true } };
		body.cloud.parameters = ParameterColumns(4);
		body.cloud.parameters[3].assign(body.cloud.size(), phi);
		StepReport report;
		EXPECT_TRUE(StepSystem<Dim>(body.cloud, body.model, Load<Dim>(), report).isSymmetric());
		body.cloud.parameters[3].back() = 0.1;
		EXPECT_FALSE(StepSystem<Dim>(body.cloud, body.model, Load<Dim>(), report).isSymmetric());
	}

} // namespace
} // namespace gimpm::testOwnParameters
