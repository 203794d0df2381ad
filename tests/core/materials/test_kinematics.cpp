// SPDX-License-Identifier: GPL-2.0-or-later
// Finite-strain kinematics of one point.
#include "core/materials/hencky.hpp"
#include "core/materials/kinematics.hpp"
#include "scenes.hpp"

namespace gimpm {
namespace {

	template <class Dimension> class Kinematics : public ::testing::Test {
	public:
		static constexpr int Dim = Dimension::value;

		Random random;

		SymTensor<Dim> tensor(double size)
		{
			SymTensor<Dim> t;
			for (double& component : t.c)
				component = random.in(-size, size);
			return t;
		}
		/// A tensor with two principal values in the plane that differ by `gap`, in random axes.
		SymTensor<Dim> almostEqual(double value, double gap) { return assemble(Vec3(value, value + gap, 0.3), random.rotation<Dim>()); }
	};
	TYPED_TEST_SUITE(Kinematics, BothDimensions, DimensionName);

	TYPED_TEST(Kinematics, PrincipalValuesAndAxesRebuildTheTensor)
	{
		constexpr int Dim = TypeParam::value;
		for (int i = 0; i < 200; ++i) {
			const double size = std::pow(10, this->random.in(-100, 100));
			auto         t    = i % 2 == 0 ? this->tensor(1) : this->almostEqual(0.1, std::pow(10, -i / 12.));
			if (i % 7 == 0) t.c.setZero(), t.c[i % t.c.size()] = -1; // a single component
			t.c *= size;
			const auto p = principal(t);
			EXPECT_LT((assemble(p.value, p.axes).c - t.c).norm(), 1e-14 * t.c.norm());
			EXPECT_LT((p.axes.transpose() * p.axes - Mat<Dim>::Identity()).norm(), 1e-14);
		}
	}

	TYPED_TEST(Kinematics, PrincipalAxesOfATensorWithoutShearAreTheGridAxes)
	{
		constexpr int  Dim = TypeParam::value;
		SymTensor<Dim> t   = SymTensor<Dim>::from(Mat3(Vec3(0.2, -0.7, 0.1).asDiagonal()));
		const auto     p   = principal(t);
		for (int i = 0; i < Dim; ++i)
			EXPECT_EQ(p.axes.col(i).cwiseAbs().maxCoeff(), 1);
		EXPECT_LT((assemble(p.value, p.axes).c - t.c).norm(), precision);
	}

	TYPED_TEST(Kinematics, LogarithmicStrainSurvivesTheWayThroughLeftCauchyGreen)
	{
		for (const double size : { 0.3, 1e-3, 1e-8, 1e-15, 1e-100, 1e-280 })
			for (int i = 0; i < 50; ++i) {
				const auto strain = this->tensor(size);
				const auto p      = principal(leftCauchyGreenMinusOne(strain));
				EXPECT_LT((assemble(logStrain(p.value), p.axes).c - strain.c).norm() / size, 2e-14) << size;
			}
	}

	TYPED_TEST(Kinematics, PushForwardIsFbFt)
	{
		constexpr int Dim = TypeParam::value;
		for (int i = 0; i < 100; ++i) {
			const auto     b1   = leftCauchyGreenMinusOne(this->tensor(0.4));
			const Mat<Dim> grad = this->random.template matrix<Dim, Dim>(0.5);
			Mat3           dF   = Mat3::Identity();
			dF.topLeftCorner<Dim, Dim>() += grad;
			const Mat3 expected = dF * (b1.full() + Mat3::Identity()) * dF.transpose() - Mat3::Identity();
			EXPECT_LT((pushForward(b1, grad).full() - expected).norm(), 1e-14);
		}
	}

	TYPED_TEST(Kinematics, RotationLeavesPrincipalStrains)
	{
		constexpr int Dim = TypeParam::value;
		for (int i = 0; i < 50; ++i) {
			const auto     strain       = this->tensor(0.3);
			const Mat<Dim> R            = this->random.template rotation<Dim>();
			const auto     p            = principal(pushForward(leftCauchyGreenMinusOne(strain), Mat<Dim>(R - Mat<Dim>::Identity())));
			const auto     rotated      = assemble(logStrain(p.value), p.axes);
			Mat3           Q            = Mat3::Identity();
			Q.topLeftCorner<Dim, Dim>() = R;
			EXPECT_LT((rotated.full() - Q * strain.full() * Q.transpose()).norm(), 1e-14);
		}
	}

	TYPED_TEST(Kinematics, StressOfTinyStrainsIsAsPreciseAsThatOfLargeOnes)
	{
		// linear elasticity of the displacement gradient; the terms left out are of the relative size of the
		// strain
		constexpr int Dim = TypeParam::value;
		const Hencky  law(2.6, 0.3); // G = 1, lambda = 1.5
		for (const double size : { 1e-11, 1e-14, 1e-20, 1e-100, 1e-300 })
			for (int i = 0; i < 20; ++i) {
				const Mat<Dim> grad              = this->random.template matrix<Dim, Dim>();
				const auto     p                 = principal(pushForward(SymTensor<Dim>(), Mat<Dim>(size * grad)));
				const auto     r                 = law.respond(logStrain(p.value), law.initialInternals());
				Mat3           strain            = Mat3::Zero();
				strain.topLeftCorner<Dim, Dim>() = 0.5 * (grad + grad.transpose());
				const Mat3 linear                = 2 * strain + 1.5 * strain.trace() * Mat3::Identity();
				EXPECT_LT((assemble(r.stress, p.axes).full() / size - linear).norm(), 1e-10 * linear.norm()) << size;
			}
	}

} // namespace
} // namespace gimpm
