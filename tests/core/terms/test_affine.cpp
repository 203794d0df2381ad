// SPDX-License-Identifier: GPL-2.0-or-later
// Blocks whose surface is given an affine motion: inside, the finite-strain solution is known in closed form.
#include "core/materials/kinematics.hpp"
#include "scenes.hpp"
#include <Eigen/Eigenvalues>

namespace gimpm::testAffine {
namespace {

	constexpr double young = 2.6e6, poisson = 0.3, yield = 5e4, G = 1e6, K = 13e6 / 6;

	/// A function of the eigenvalues of a symmetric tensor.
	template <class F> Mat3 isotropic(const Mat3& t, F&& f)
	{
		const Eigen::SelfAdjointEigenSolver<Mat3> eigen(t);
		return eigen.eigenvectors() * eigen.eigenvalues().unaryExpr(f).asDiagonal() * eigen.eigenvectors().transpose();
	}

	template <int Dim> Mat3 in3D(const Mat<Dim>& m)
	{
		Mat3 full                      = Mat3::Identity();
		full.topLeftCorner<Dim, Dim>() = m;
		return full;
	}

	/// Cauchy stress after the deformation F from an elastic strain.
	Mat3 exactStress(const Mat3& F, const Mat3& strain, bool plastic)
	{
		const Mat3 b   = F * isotropic(strain, [](double e) { return std::exp(2 * e); }) * F.transpose();
		const Mat3 e   = isotropic(b, [](double x) { return 0.5 * std::log(x); });
		Mat3       dev = e - e.trace() / 3 * Mat3::Identity();
		if (plastic) dev *= std::min(1., yield / (2 * G * dev.norm()));
		return (2 * G * dev + K * e.trace() * Mat3::Identity()) / F.determinant();
	}

	template <int Dim> struct AffineBlock {
		Model<Dim>      model;
		PointCloud<Dim> cloud;
		LinearSolver    solver;

		AffineBlock()
		{
			model.grid             = { 0.5, Vec<Dim>::Zero() };
			model.materials        = { { Hencky(young, poisson), 1 }, { VonMises(young, poisson, yield), 1 } };
			model.newton.tolerance = 1e-13;
			cloud                  = block<Dim>(model.grid, Index<Dim>::Constant(3), 2);
		}
		/// Moves the surface by x -> shift + F x and checks that all points followed; returns the report.
		StepReport move(const Mat<Dim>& F, const Vec<Dim>& shift)
		{
			const auto motion = [&](const Vec<Dim>& x) { return Vec<Dim>(shift + F * x); };
			model.boundary    = Boundary<Dim>(
                                prescribedSurface<Dim>(model.grid, Index<Dim>::Constant(3), [&](const Vec<Dim>& x) { return Vec<Dim>(motion(x) - x); }));
			const auto before = cloud;
			const auto report = loadStep(cloud, model, {}, solver);
			EXPECT_TRUE(report.converged()) << report.cause;
			for (std::size_t p = 0; p < cloud.size(); ++p) {
				EXPECT_LT((cloud.position[p] - motion(before.position[p])).norm(), 1e-12);
				EXPECT_LT((cloud.defGrad[p] - F * before.defGrad[p]).norm(), 1e-12);
			}
			return report;
		}
	};

	template <class Dimension> using Affine = InBothDimensions<Dimension>;
	TYPED_TEST_SUITE(Affine, BothDimensions, DimensionName);

	TYPED_TEST(Affine, ObliqueShearedBlockHasTheExactStress)
	{
		constexpr int Dim = TypeParam::value;
		Random        random(3);
		for (int i = 0; i < 10; ++i) {
			AffineBlock<Dim> block;
			for (std::size_t p = 0; p < block.cloud.size(); ++p)
				block.cloud.material[p] = i % 2;
			const Mat<Dim> F = Mat<Dim>::Identity() + random.matrix<Dim, Dim>(0.3);
			block.move(F, random.matrix<Dim>());
			const Mat3 expected = exactStress(in3D<Dim>(F), Mat3::Zero(), i % 2 == 1);
			for (std::size_t p = 0; p < block.cloud.size(); ++p) {
				EXPECT_LT((block.cloud.stress[p].full() - expected).norm(), 1e-11 * young);
				EXPECT_EQ(plasticStrains(block.cloud)[p] > 0, i % 2 == 1);
			}
		}
	}

	TYPED_TEST(Affine, ASecondDeformationContinuesFromTheElasticStrain)
	{
		constexpr int    Dim = TypeParam::value;
		Random           random(4);
		AffineBlock<Dim> block;
		const auto       strain = assemble(Vec3(0.2, -0.3, 0.1), random.rotation<Dim>());
		for (auto& e : block.cloud.elasticStrain)
			e = strain;
		const Mat<Dim> F = Mat<Dim>::Identity() + random.matrix<Dim, Dim>(0.2);
		block.move(F, Vec<Dim>::Zero());
		const Mat3 expected = exactStress(in3D<Dim>(F), strain.full(), false);
		for (const auto& stress : block.cloud.stress)
			EXPECT_LT((stress.full() - expected).norm(), 1e-11 * young);
	}

	TYPED_TEST(Affine, RigidRotationTurnsTheStressOfAStressedBlock)
	{
		constexpr int Dim = TypeParam::value;
		Random        random(5);
		for (int i = 0; i < 5; ++i) {
			AffineBlock<Dim> block;
			block.model.domains = DomainRule::stretch; // 90 degrees aside, boxes that tile are others for each angle
			// a state of strain on the yield surface of the second material, so that the least excess would
			// yield
			Mat3       strain = assemble(Vec3(0.2, -0.3, 0.1), random.rotation<Dim>()).full();
			const Mat3 mean   = strain.trace() / 3 * Mat3::Identity();
			strain            = mean + (strain - mean) * (yield / (2 * G) / (strain - mean).norm());
			const Mat<Dim> V  = Mat<Dim>::Identity() + 0.2 * Mat<Dim>::Ones(); // deformation of the block before
			for (std::size_t p = 0; p < block.cloud.size(); ++p) {
				block.cloud.material[p]      = i % 2;
				block.cloud.elasticStrain[p] = SymTensor<Dim>::from(strain);
				block.cloud.defGrad[p]       = V;
				// U = V.
				block.cloud.halfSize0[p] = block.cloud.halfSize[p].cwiseQuotient(V.diagonal());
			}
			const Mat<Dim> R      = random.rotation<Dim>();
			const Mat3     before = exactStress(Mat3::Identity(), strain, false) / V.determinant(), Q = in3D<Dim>(R);
			const auto     sizes = block.cloud.halfSize;
			block.move(R, random.matrix<Dim>());
			for (std::size_t p = 0; p < block.cloud.size(); ++p) {
				EXPECT_LT((block.cloud.stress[p].full() - Q * before * Q.transpose()).norm(), 1e-12 * young);
				EXPECT_LT((block.cloud.elasticStrain[p].full() - Q * strain * Q.transpose()).norm(), 1e-13);
				EXPECT_LT((block.cloud.halfSize[p] - sizes[p]).norm(), 1e-13) << "domains do not follow rotations";
				EXPECT_LT(plasticStrains(block.cloud)[p], 1e-13);
			}
		}
	}

} // namespace
} // namespace gimpm::testAffine
