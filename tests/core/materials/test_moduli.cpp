// SPDX-License-Identifier: GPL-2.0-or-later
// The spatial moduli against derivatives of the stress that the nodes feel.
//
// The force on a node is V_0 tau dF^-T times the gradient of its basis function at the start of the step, so the moduli
// A = J a must be
//   A_ijkl = dF_jJ dF_lL d(tau dF^-T)_iJ / d(dF)_kL.
#include "core/materials/kinematics.hpp"
#include "core/materials/law.hpp"
#include "scenes.hpp"

namespace gimpm::testModuli {
namespace {

	template <class Dimension> class SpatialModuli : public ::testing::Test {
	public:
		static constexpr int Dim = Dimension::value;

		Random random { 5 };

		template <class Law> static Response response(const Law& law, const SymTensor<Dim>& b1, const Mat<Dim>& grad, Principal<Dim>& p)
		{
			p = principal(pushForward(b1, grad));
			return law.respond(logStrain(p.value), law.initialInternals());
		}
		template <class Law> static Mat<Dim> nodalStress(const Law& law, const SymTensor<Dim>& b1, const Mat<Dim>& grad)
		{
			Principal<Dim> p;
			const auto     r = response(law, b1, grad, p);
			return assemble(r.stress, p.axes).inPlane() * (Mat<Dim>::Identity() + grad).inverse().transpose();
		}
		template <class Law> static Moduli<Dim> moduli(const Law& law, const SymTensor<Dim>& b1, const Mat<Dim>& grad)
		{
			Principal<Dim> p;
			const auto     r = response(law, b1, grad, p);
			return spatialModuli<Dim>(r, logStrain(p.value), p.axes);
		}
		/// Fourth-order central differences.
		template <class Law> static Moduli<Dim> differences(const Law& law, const SymTensor<Dim>& b1, const Mat<Dim>& grad, double step)
		{
			const Mat<Dim> dF = Mat<Dim>::Identity() + grad;
			Moduli<Dim>    A  = Moduli<Dim>::Zero();
			for (int k = 0; k < Dim; ++k)
				for (int L = 0; L < Dim; ++L) {
					const auto at = [&](double s) {
						Mat<Dim> g = grad;
						g(k, L) += s * step;
						return nodalStress(law, b1, g);
					};
					const Mat<Dim> dP = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * step), dT = dP * dF.transpose();
					for (int i = 0; i < Dim; ++i)
						for (int j = 0; j < Dim; ++j)
							for (int l = 0; l < Dim; ++l)
								A(i * Dim + j, k * Dim + l) += dT(i, j) * dF(l, L);
				}
			return A;
		}
		template <class Law> void expectDerivative(const Law& law, const SymTensor<Dim>& b1, const Mat<Dim>& grad, double step, double tolerance)
		{
			const auto A = moduli(law, b1, grad);
			EXPECT_LT((A - differences(law, b1, grad, step)).norm(), tolerance * A.norm());
			EXPECT_LT((A - A.transpose()).norm(), 1e-14 * A.norm()) << "associated isotropic laws have symmetric moduli";
		}
		SymTensor<Dim> strained(const Vec3& strain) { return leftCauchyGreenMinusOne(assemble(strain, random.rotation<Dim>())); }
		Mat<Dim>       deformation(double size)
		{
			return random.rotation<Dim>() * (Mat<Dim>::Identity() + random.matrix<Dim, Dim>(size)) - Mat<Dim>::Identity();
		}
	};
	TYPED_TEST_SUITE(SpatialModuli, BothDimensions, DimensionName);

	const Hencky   elastic(2.6, 0.3);
	const VonMises plastic(2.6, 0.3, 0.05); // yields at deviators of 0.025

	TYPED_TEST(SpatialModuli, OfRotatedAndShearedElasticStates)
	{
		for (int i = 0; i < 20; ++i)
			this->expectDerivative(elastic, this->strained(this->random.template matrix<3>(0.3)), this->deformation(0.3), 1e-3, 1e-9);
	}

	TYPED_TEST(SpatialModuli, OfRotatedAndShearedPlasticStates)
	{
		for (int i = 0; i < 20; ++i)
			this->expectDerivative(plastic, this->strained({ 0.4, -0.3 + 0.02 * i, 0.1 }), this->deformation(0.1), 3e-4, 1e-8);
	}

	TYPED_TEST(SpatialModuli, OfLargeStrains)
	{
		for (const Vec3& strain : { Vec3(2, -2, 1), Vec3(-3, 0.5, 0), Vec3(3, 3, 3) }) {
			this->expectDerivative(elastic, this->strained(strain), this->deformation(0.2), 1e-3, 1e-8);
			this->expectDerivative(plastic, this->strained(strain), this->deformation(0.2), 1e-3, 1e-8);
		}
	}

	TYPED_TEST(SpatialModuli, WithCoincidingPrincipalStretches)
	{
		// Rotations keep the stretches of b together, to round-off or, without rotation, exactly.
		constexpr int  Dim  = TypeParam::value;
		const Mat<Dim> none = Mat<Dim>::Zero(), turned = this->random.template rotation<Dim>() - Mat<Dim>::Identity();
		for (const Vec3& strain : { Vec3(0.1, 0.1, -0.3), Vec3(-0.2, -0.2, 0.2), Vec3(-0.3, 0.1, 0.1), Vec3(0.2, 0.2, 0.2), Vec3(0, 0, 0) })
			for (const Mat<Dim>& grad : { none, turned }) {
				this->expectDerivative(elastic, this->strained(strain), grad, 1e-3, 1e-9);
				this->expectDerivative(elastic, leftCauchyGreenMinusOne(SymTensor<Dim>::from(Mat3(strain.asDiagonal()))), grad, 1e-3, 1e-9);
				// The last two are elastic.
				this->expectDerivative(plastic, this->strained(strain), grad, 3e-4, 1e-8);
			}
	}

	TYPED_TEST(SpatialModuli, AreContinuousWhereStretchesMeet)
	{
		constexpr int  Dim  = TypeParam::value;
		const Mat<Dim> none = Mat<Dim>::Zero(), axes = this->random.template rotation<Dim>();
		const auto at = [&](double gap) { return this->moduli(plastic, leftCauchyGreenMinusOne(assemble(Vec3(0.1, 0.1 + gap, -0.3), axes)), none); };
		const auto together = at(0);
		for (double gap = 1e-3; gap > 1e-18; gap /= 10)
			EXPECT_LT((at(gap) - together).norm(), (5 * gap + 1e-13) * together.norm()) << gap;
	}

	TYPED_TEST(SpatialModuli, AtTinyStrainsAreThoseOfLinearElasticity)
	{
		// A_ijkl = lambda delta_ij delta_kl + G (delta_ik delta_jl + delta_il delta_jk), G = 1, lambda = 1.5
		constexpr int Dim    = TypeParam::value;
		Moduli<Dim>   linear = Moduli<Dim>::Zero();
		for (int i = 0; i < Dim; ++i)
			for (int j = 0; j < Dim; ++j) {
				linear(i * Dim + i, j * Dim + j) += 1.5;
				linear(i * Dim + j, i * Dim + j) += 1;
				linear(i * Dim + j, j * Dim + i) += 1;
			}
		for (const double size : { 1e-14, 1e-20, 1e-100, 1e-300, 0. }) {
			const Mat<Dim> grad = this->random.template matrix<Dim, Dim>(size);
			EXPECT_LT((this->moduli(elastic, SymTensor<Dim>(), grad) - linear).norm(), 1e-13 * linear.norm()) << size;
		}
	}

} // namespace
} // namespace gimpm::testModuli
