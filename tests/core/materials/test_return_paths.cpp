// SPDX-License-Identifier: GPL-2.0-or-later
// Paths of one point in finite strain, against closed forms.
#include "core/materials/kinematics.hpp"
#include "core/materials/law.hpp"
#include "scenes.hpp"
#include <cstdio>

namespace gimpm::testReturnPaths {
namespace {

	/// The state of one point that follows increments of the deformation gradient.
	template <int Dim> struct PathPoint {
		Law             law;
		SymTensor<Dim>  elasticStrain {}, stress {}; // Kirchhoff
		InternalColumns internals {};

		double plasticStrain() const
		{
			const auto& column = internals[internalVariables.find("plasticStrain")];
			return column.empty() ? 0 : column[0];
		}

		void apply(const Mat<Dim>& grad)
		{
			const auto p = principal(pushForward(leftCauchyGreenMinusOne(elasticStrain), grad));
			withLaw(law, [&](const auto& l) {
				const auto r  = l.respond(logStrain(p.value), internalsOf(l, internals, 0));
				elasticStrain = assemble(r.elasticStrain, p.axes);
				stress        = assemble(r.stress, p.axes);
				provideInternals(internals, { { law, 1 } }, 1);
				storeInternals(l, r.internals, internals, 0);
			});
		}
	};

	template <class Dimension> class Path : public ::testing::Test {
	public:
		static constexpr int Dim = Dimension::value;

		static Mat<Dim> shearing(double g)
		{
			Mat<Dim> grad = Mat<Dim>::Zero();
			grad(0, 1)    = g;
			return grad;
		}
		static Mat<Dim> stretching(double x, double y)
		{
			Mat<Dim> grad = Mat<Dim>::Zero();
			grad(0, 0) = x - 1, grad(1, 1) = y - 1;
			return grad;
		}
	};
	TYPED_TEST_SUITE(Path, BothDimensions, DimensionName);

	constexpr double G = 1, K = 13. / 6, yield = 0.05; // E = 2.6, nu = 0.3

	// Plane-strain compression without change of volume: the trial deviator keeps its direction, so the return is
	// exact for any steps. Yield at 2 G sqrt(2) e = yield; from there on the stress stays and the strain flows.
	TYPED_TEST(Path, PlaneStrainCompressionWithoutChangeOfVolume)
	{
		constexpr int  Dim = TypeParam::value;
		PathPoint<Dim> point { VonMises(2.6, 0.3, yield) };
		const double   step = std::exp(0.004);
		for (int i = 1; i <= 200; ++i) {
			point.apply(this->stretching(step, 1 / step));
			const double e = 0.004 * i, s = std::min(2 * G * e, yield / std::sqrt(2.));
			EXPECT_NEAR(point.stress.full()(0, 0), s, 1e-13);
			EXPECT_NEAR(point.stress.full()(1, 1), -s, 1e-13);
			EXPECT_NEAR(point.stress.full()(2, 2), 0, 1e-13);
			EXPECT_NEAR(point.plasticStrain(), std::sqrt(2. / 3) * std::max(0., std::sqrt(2.) * e - yield / (2 * G)), 1e-12);
		}
	}

	// The same with a yield stress that grows with the flow, or falls with it to a residual one, which a step may
	// pass: 2 G sqrt(2) e = yield(a) + 2 G sqrt(3/2) a.
	TYPED_TEST(Path, HardeningAndSofteningFollowTheClosedForm)
	{
		constexpr int Dim  = TypeParam::value;
		const double  step = std::exp(0.004);
		for (const auto& [hardening, residual] : { std::pair { 0.5, 0. }, std::pair { -0.1, 0.02 }, std::pair { -2., 0.01 } }) {
			PathPoint<Dim> point { VonMises(2.6, 0.3, yield, hardening, residual) };
			for (int i = 1; i <= 200; ++i) {
				point.apply(this->stretching(step, 1 / step));
				const double trial = 2 * G * std::sqrt(2.) * 0.004 * i;
				const double flow  = std::max(0., (trial - yield) / (hardening + 2 * G * std::sqrt(1.5)));
				const double size  = flow > 0 ? std::max(yield + hardening * flow, residual) : trial;
				EXPECT_NEAR(point.stress.full()(0, 0), size / std::sqrt(2.), 1e-12);
				EXPECT_NEAR(point.plasticStrain(), std::sqrt(2. / 3) * (trial - size) / (2 * G), 1e-12);
			}
			if (hardening < 0) {
				EXPECT_NEAR(point.stress.full()(0, 0), residual / std::sqrt(2.), 1e-13);
			}
		}
	}

	// Confined compression: deviator e (1/3, -2/3, 1/3), |dev| = sqrt(2/3) e; the pressure goes on rising after
	// yield.
	TYPED_TEST(Path, ConfinedCompression)
	{
		constexpr int  Dim = TypeParam::value;
		PathPoint<Dim> point { VonMises(2.6, 0.3, yield) };
		for (int i = 1; i <= 100; ++i) {
			point.apply(this->stretching(1, std::exp(-0.01)));
			const double e = 0.01 * i, s = std::min(2 * G * std::sqrt(2. / 3) * e, yield) / std::sqrt(6.);
			EXPECT_NEAR(point.stress.full()(1, 1), -K * e - 2 * s, 1e-13);
			EXPECT_NEAR(point.stress.full()(0, 0), -K * e + s, 1e-13);
			EXPECT_NEAR(point.stress.full()(2, 2), -K * e + s, 1e-13);
		}
	}

	// Simple shear F = 1 + g e_x e_y of an elastic point: principal strains +-e, sinh e = g/2, axis at tan(angle) =
	// exp(-e).
	TYPED_TEST(Path, ElasticSimpleShearWithLargeRotation)
	{
		constexpr int Dim = TypeParam::value;
		for (const int steps : { 1, 10, 1000 }) {
			PathPoint<Dim> point { Hencky(2.6, 0.3) };
			for (int i = 1; i <= steps; ++i) {
				point.apply(this->shearing(6. / steps));
				const double e = std::asinh(3. * i / steps);
				EXPECT_NEAR(point.stress.full()(0, 1), 2 * G * e / std::cosh(e), 1e-11);
				EXPECT_NEAR(point.stress.full()(0, 0), 2 * G * e * std::tanh(e), 1e-11);
				EXPECT_NEAR(point.stress.full()(1, 1), -2 * G * e * std::tanh(e), 1e-11);
			}
		}
	}

	// Simple shear of a von Mises point. After yield the principal elastic strains stay at +-e_y = yield / (2
	// sqrt(2) G) while their axes turn. With the angle a of the first axis, t = tan a, plastic flow along the axes
	// and db/dg = l b + b l^T, l = e_x e_y:
	//   dt/dg = (exp(-2 e_y) - t^2 exp(2 e_y)) / (2 sinh 2 e_y),  t = exp(-e_y) at yield,
	// which has the solution t = exp(-2 e_y) coth((g - g_y) / (2 sinh 2 e_y) + arcoth exp(e_y)).
	struct ShearFlow {
		double e, g;

		explicit ShearFlow(double yieldStress) : e(yieldStress / (2 * std::sqrt(2.) * G)), g(2 * std::sinh(e)) { }
		double angle(double shear) const
		{
			const double arcoth = std::atanh(std::exp(-e));
			return std::atan(std::exp(-2 * e) / std::tanh((shear - g) / (2 * std::sinh(2 * e)) + arcoth));
		}
		double shearStress(double shear) const { return 2 * G * e * std::sin(2 * angle(shear)); }
		double normalStress(double shear) const { return 2 * G * e * std::cos(2 * angle(shear)); }
	};

	TYPED_TEST(Path, PlasticSimpleShearConvergesToTheClosedForm)
	{
		// A large yield stress, so that the axes turn visibly while the point flows: e_y = 0.25, g_y = 0.505.
		constexpr int   Dim = TypeParam::value;
		const ShearFlow exact(std::sqrt(0.5));
		const double    end      = 0.9;
		double          previous = 0;
		for (const int steps : { 40, 80, 160, 320 }) {
			PathPoint<Dim> point { VonMises(2.6, 0.3, std::sqrt(0.5)) };
			double         error = 0;
			for (int i = 1; i <= steps; ++i) {
				point.apply(this->shearing(end / steps));
				const double g = end * i / steps;
				if (g < exact.g) continue;
				const Mat3 stress = point.stress.full();
				error = std::max({ error, std::abs(stress(0, 1) - exact.shearStress(g)), std::abs(stress(0, 0) - exact.normalStress(g)) });
			}
			std::printf("%4d steps: error %.3e, order %.3f\n", steps, error, previous > 0 ? std::log2(previous / error) : NAN);
			// The return is a backward Euler step, of first order.
			if (previous > 0) {
				EXPECT_NEAR(std::log2(previous / error), 1, 0.1);
			}
			previous = error;
		}
		EXPECT_LT(previous, 1e-3);
	}

	TYPED_TEST(Path, PlasticSimpleShearEndsAtTheSteadyState)
	{
		// tan a = exp(-2 e_y): shear stress 2 G e_y / cosh 2 e_y, normal stress 2 G e_y tanh 2 e_y
		constexpr int   Dim = TypeParam::value;
		const ShearFlow exact(yield);
		const auto      sheared = [&](int steps) {
                        PathPoint<Dim> point { VonMises(2.6, 0.3, yield) };
                        for (int i = 0; i < steps; ++i)
                                point.apply(this->shearing(4. / steps)); // the material turns by far more than the stress
                        return point.stress.full();
		};
		const Mat3 stress = 2 * sheared(8000) - sheared(4000); // without the first-order error of the steps
		EXPECT_NEAR(stress(0, 1), 2 * G * exact.e / std::cosh(2 * exact.e), 1e-8);
		EXPECT_NEAR(stress(0, 0), 2 * G * exact.e * std::tanh(2 * exact.e), 1e-8);
		EXPECT_NEAR(stress(1, 1), -stress(0, 0), 1e-12);
	}

	TYPED_TEST(Path, UnloadingIsElastic)
	{
		constexpr int  Dim = TypeParam::value;
		PathPoint<Dim> point { VonMises(2.6, 0.3, yield) };
		point.apply(this->stretching(std::exp(0.1), std::exp(-0.1)));
		const double flow = point.plasticStrain(), s = point.stress.full()(0, 0);
		point.apply(this->stretching(std::exp(-0.01), std::exp(0.01)));
		EXPECT_EQ(point.plasticStrain(), flow);
		EXPECT_NEAR(point.stress.full()(0, 0), s - 2 * G * 0.01, 1e-14);
	}

	// A path seen from a frame that turns by R_k with each increment: dF* = R_k dF R_(k-1)^T, and the stress must
	// turn along.
	TYPED_TEST(Path, StressTurnsWithTheFrame)
	{
		constexpr int Dim = TypeParam::value;
		Random        random;
		for (const Law& law : { Law(Hencky(2.6, 0.3)), Law(VonMises(2.6, 0.3, yield)) }) {
			PathPoint<Dim> point { law }, turned { law };
			Mat<Dim>       frame = Mat<Dim>::Identity();
			for (int i = 0; i < 50; ++i) {
				const Mat<Dim> grad = random.matrix<Dim, Dim>(0.1), next = random.rotation<Dim>();
				point.apply(grad);
				turned.apply(next * (Mat<Dim>::Identity() + grad) * frame.transpose() - Mat<Dim>::Identity());
				frame                       = next;
				Mat3 R                      = Mat3::Identity();
				R.topLeftCorner<Dim, Dim>() = frame;
				EXPECT_LT((turned.stress.full() - R * point.stress.full() * R.transpose()).norm(), 1e-12);
				EXPECT_NEAR(turned.plasticStrain(), point.plasticStrain(), 1e-12);
			}
			EXPECT_EQ(point.plasticStrain() > 0.5, law.principal().is.index() == 1);
		}
	}

} // namespace
} // namespace gimpm::testReturnPaths
