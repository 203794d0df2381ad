// SPDX-License-Identifier: GPL-2.0-or-later
// K + K_g against the finite-difference derivative of the nodal forces, for random clouds in finite strain.
#include "core/materials/kinematics.hpp"
#include "core/stepping/step_system.hpp"
#include "core/terms/points/point_update.hpp"
#include "derivatives.hpp"
#include "scenes.hpp"
#include <algorithm>

namespace gimpm {
namespace {

	/// Random overlapping domains on 3 cells a side, partly against a wall, of an elastic and a plastic material,
	/// with ghost faces.
	template <int Dim> struct Scene {
		Random          random { 11 };
		Model<Dim>      model;
		PointCloud<Dim> cloud;

		Scene()
		{
			model.materials = { { Hencky(3e3, 0.3), 1 }, { VonMises(1e3, 0.2, 50), 1 } };
			model.ghost     = { 0.1 };
			model.boundary  = Boundary<Dim>({ wallBelow<Dim>(model.grid, 0, 0) });
			for (int i = 0; i < (Dim == 2 ? 40 : 25); ++i) {
				const Vec<Dim> x = 1.2 * (random.matrix<Dim>() + Vec<Dim>::Ones());
				addPoint<Dim>(cloud, x, Vec<Dim>::NullaryExpr([&]() { return random.in(0.1, 0.5); }), i % 2);
			}
		}
		void strain(const Vec3& principalStrains, double scatter)
		{
			for (auto& e : cloud.elasticStrain)
				e = assemble(Vec3(principalStrains + random.matrix<3>(scatter)), random.rotation<Dim>());
		}
		/// The largest difference between K and the derivative of the forces (fourth-order central), relative
		/// to the largest entry of K. The displacements are those of an affine deformation plus random ones.
		double error(const Mat<Dim>& deformation, double scatter)
		{
			StepReport            report;
			const StepSystem<Dim> system(cloud, model, {}, report);
			EXPECT_GT(report.ghostFaces, 5);
			EXPECT_EQ(report.largestWallOverlap > 0, model.basis == Basis::gimp);
			Eigen::VectorXd d = nodal<Dim>(system.basis, model.grid, [&](const Vec<Dim>& x) { return Vec<Dim>(deformation * x - x); });
			d += random.vector(d.size(), scatter);
			const auto [K, expected] = tangentAndDerivative(system, d, 1e-4);
			return relativeError(K, expected);
		}
		int plasticPoints(const Mat<Dim>& deformation)
		{
			StepReport            report;
			const StepSystem<Dim> system(cloud, model, {}, report);
			std::vector<char>     isPlastic(cloud.size());
			const auto            d = nodal<Dim>(system.basis, model.grid, [&](const Vec<Dim>& x) { return Vec<Dim>(deformation * x - x); });
			forUpdatedPoints<Dim>(
			        system.basis, system.points, model.materials, d, [&](int p, const PointUpdate<Dim>& u) { isPlastic[p] = u.internals[0] > 0; });
			return int(std::count(isPlastic.begin(), isPlastic.end(), 1));
		}
	};

	template <class Dimension> class Tangent : public ::testing::Test {
	public:
		static constexpr int Dim = Dimension::value;

		Scene<Dim> scene;
		Mat<Dim>   identity = Mat<Dim>::Identity();

		/// Sheared by 0.5, stretched, and rotated by about 60 degrees.
		Mat<Dim> deformation() const
		{
			Mat<Dim> F = identity;
			F(0, 1) = 0.5, F(0, 0) = 1.3;
			return turned() * F;
		}
		Mat<Dim> turned() const
		{
			if constexpr (Dim == 2) return planeRotation(1);
			else
				return rotation({ 1, 2, -1 }, 1);
		}
	};
	TYPED_TEST_SUITE(Tangent, BothDimensions, DimensionName);

	TYPED_TEST(Tangent, OfTheUndeformedState) { EXPECT_LT(this->scene.error(this->identity, 0), 1e-9); }

	TYPED_TEST(Tangent, OfAShearedRotatedAndPlasticState)
	{
		this->scene.strain({ 0.1, -0.05, 0 }, 0.1);
		EXPECT_GT(this->scene.plasticPoints(this->deformation()), 10);
		EXPECT_LT(this->scene.error(this->deformation(), 0.05), 1e-7);
	}

	TYPED_TEST(Tangent, OfSoil)
	{
		constexpr double degree = 0.017453292519943295;
		const auto       cone   = DruckerPragerCone::planeStrain(20, 30 * degree, 0);
		for (const Law& law : { Law(MohrCoulomb(1e3, 0.2, 20, 30 * degree, 30 * degree)), Law(MohrCoulomb(1e3, 0.2, 20, 30 * degree, 0)),
		                        Law(MohrCoulomb(1e3, 0.2, 20, 30 * degree, 10 * degree, 5)), Law(MohrCoulomb::tresca(1e3, 0.2, 20)),
		                        Law(DruckerPrager(1e3, 0.2, cone)), Law(CamClay(400, 1.2, 0.4, 0.1, 400, 300)) }) {
			this->scene.model.materials[1] = { law, 1 };
			this->scene.strain({ 0.05, -0.05, -0.02 }, 0.1);
			EXPECT_GT(this->scene.plasticPoints(this->deformation()), 10);
			EXPECT_LT(this->scene.error(this->deformation(), 0.05), 1e-6) << law.principal().is.index();
		}
	}

	TYPED_TEST(Tangent, WithCoincidingPrincipalStretches)
	{
		// rotation leaves the stretches together, to round-off; yield begins at a deviator of 50 / 2G = 0.06
		for (const Vec3& strain : { Vec3(0.1, 0.1, -0.2), Vec3(-0.2, 0.1, 0.1), Vec3(0.02, 0.02, 0), Vec3(0.2, 0.2, 0.2), Vec3(0, 0, 0) }) {
			this->scene.strain(strain, 0);
			EXPECT_LT(this->scene.error(this->identity, 0), 1e-7) << strain.transpose();
			EXPECT_LT(this->scene.error(this->turned(), 0), 1e-7) << strain.transpose();
		}
	}

	TYPED_TEST(Tangent, WithLinearBasisFunctions)
	{
		this->scene.model.basis = Basis::linear;
		this->scene.strain({ 0.1, -0.05, 0 }, 0.1);
		EXPECT_LT(this->scene.error(this->deformation(), 0.05), 1e-7);
	}

	TYPED_TEST(Tangent, WithFBar)
	{
		this->scene.model.fBar = true;
		EXPECT_LT(this->scene.error(this->identity, 0), 1e-9);
		this->scene.strain({ 0.1, -0.05, 0 }, 0.1);
		EXPECT_GT(this->scene.plasticPoints(this->deformation()), 10);
		EXPECT_LT(this->scene.error(this->deformation(), 0.05), 1e-7);
		this->scene.model.basis = Basis::linear;
		EXPECT_LT(this->scene.error(this->deformation(), 0.05), 1e-7);
	}

	TYPED_TEST(Tangent, OfSoilWithFBar)
	{
		this->scene.model.fBar  = true;
		constexpr double degree = 0.017453292519943295;
		for (const Law& law : { Law(MohrCoulomb(1e3, 0.2, 20, 30 * degree, 10 * degree, 5)), Law(CamClay(400, 1.2, 0.4, 0.1, 400, 300)) }) {
			this->scene.model.materials[1] = { law, 1 };
			this->scene.strain({ 0.05, -0.05, -0.02 }, 0.1);
			EXPECT_GT(this->scene.plasticPoints(this->deformation()), 10);
			EXPECT_LT(this->scene.error(this->deformation(), 0.05), 1e-6) << law.principal().is.index();
		}
	}

} // namespace
} // namespace gimpm
