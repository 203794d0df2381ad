// SPDX-License-Identifier: GPL-2.0-or-later
// Moduli that go with a power of the pressure: closed forms, closed cycles, the tangent with all faces of strength, and
// the law without the power at a pressure that does not change.
#include "core/materials/power_elastic.hpp"
#include "element.hpp"
#include <Eigen/Eigenvalues>

namespace gimpm::testPowerElastic {
namespace {

	constexpr double young = 30e6, poisson = .3, reference = 100e3, strong = 1e9;

	PowerElastic withMohrCoulomb(double power, double c, double phi, double psi, double tension = std::numeric_limits<double>::infinity())
	{
		const PowerElastic::Moduli moduli { young, poisson, power, reference };
		const Hencky               secant = PowerElastic::secant(moduli);
		return { moduli, MohrCoulomb(secant.young(), secant.poisson(), c, phi, psi, tension) };
	}
	PowerElastic withDruckerPrager(double power, double c, double phi, double psi)
	{
		const PowerElastic::Moduli moduli { young, poisson, power, reference };
		const Hencky               secant = PowerElastic::secant(moduli);
		return { moduli,
			 DruckerPrager(
			         secant.young(), secant.poisson(), DruckerPragerCone::planeStrain(c, phi, psi), std::numeric_limits<double>::infinity()) };
	}
	Mat3 symmetric(Random& random, double size)
	{
		const Mat3 m = random.matrix<3, 3>(size);
		return (m + m.transpose()) / 2;
	}

	// Under a pressure all around, well above the hundredth of the reference below which moduli stay.
	TEST(PowerElastic, ModuliGoWithThePowerOfThePressure)
	{
		const double K = young / (3 * (1 - 2 * poisson)), G = young / (2 * (1 + poisson));
		for (const double power : { .3, .5, .9 })
			for (const double pressure : { 100e3, 1e6 }) {
				Element<PowerElastic> point(withMohrCoulomb(power, strong, 0, 0));
				point.press(Vec3::Constant(pressure));
				const auto   answer = point.ask(Mat3::Zero());
				const double factor = std::pow(pressure / reference, power), floor = std::pow(.01, 2 * (1 - power));
				EXPECT_LT((answer.stress + pressure * Mat3::Identity()).norm(), 1e-12 * pressure);
				EXPECT_NEAR(answer.tangent(3, 3) / (2 * G * factor), 1, floor) << power;
				EXPECT_NEAR((answer.tangent(0, 0) + 2 * answer.tangent(0, 1)) / (3 * K * factor), 1, 2 * floor) << power;
				EXPECT_NEAR(answer.state.scalar(PowerElastic::stiffness) / factor, 1, floor);
			}
	}

	// Along an axis e the stress is s (K_s + 4/3 G) e, with s = (kappa sqrt(e^2 (1 + 4 G / (3 K_s)) + a^2))^m and
	// m = n / (1 - n).
	TEST(PowerElastic, OedometerByItsClosedForm)
	{
		const double          n = .5, G = young / (2 * (1 + poisson)), Ks = (1 - n) * young / (3 * (1 - 2 * poisson));
		const double          kappa = Ks / reference, a = std::pow(.01, 1 - n) / kappa;
		Element<PowerElastic> point(withMohrCoulomb(n, strong, 0, 0));
		for (int step = 1; step <= 50; ++step) {
			point.apply(Vec3(0, -2e-4, 0));
			const double e = -2e-4 * step, s = std::pow(kappa * std::sqrt(e * e * (1 + 4 * G / (3 * Ks)) + a * a), n / (1 - n));
			EXPECT_NEAR(point.stress(1, 1) / (s * (Ks + 4. / 3 * G) * e), 1, 1e-12);
			EXPECT_NEAR(point.stress(0, 0) / (s * (Ks - 2. / 3 * G) * e), 1, 1e-11);
		}
	}

	// A loop through strains of all six numbers: of an energy the sum of the trapezium over a smooth closed path
	// vanishes faster than any power of the steps.
	TEST(PowerElastic, AClosedCycleGivesNoEnergy)
	{
		const auto workOf = [](int steps) {
			Element<PowerElastic> point(withMohrCoulomb(.6, strong, 0, 0));
			point.press({ 80e3, 150e3, 60e3 });
			const Mat3 first = point.stress;
			Random     random(3);
			const Mat3 A = symmetric(random, 5e-4), B = symmetric(random, 5e-4);
			double     work = 0, inPlay = 0;
			for (int i = 1; i <= steps; ++i) {
				const auto at   = [&](int k) { return Mat3(A * std::sin(2 * M_PI * k / steps) + B * (1 - std::cos(2 * M_PI * k / steps))); };
				const Mat3 step = at(i) - at(i - 1), before = point.stress;
				point.apply(step);
				const double part = ((before + point.stress) / 2).cwiseProduct(step).sum();
				work += part, inPlay += std::abs(part);
			}
			EXPECT_LT((point.stress - first).norm(), 1e-9 * first.norm());
			return work / inPlay;
		};
		for (const int steps : { 100, 1000 })
			EXPECT_LT(std::abs(workOf(steps)), 1e-11);
	}

	// Errors are those relative to the elastic stiffness.
	template <class Make> void expectTangents(Make make)
	{
		Random              random(5);
		std::vector<double> ofElastic, ofFlow;
		for (int k = 0; k < 60; ++k) {
			Element<PowerElastic> point(make(random, k));
			point.press(Vec3::Constant(random.in(1e3, 20e3)));
			for (int i = 0; i < 10; ++i) {
				const double size = std::pow(10, random.in(-4, -2)), before = point.state.scalar(PowerElastic::plasticStrain);
				Mat3         strain = symmetric(random, size);
				strain -= .1 * size * Mat3::Identity();
				const double error = point.tangentError(strain, 1e-3, young);
				point.apply(strain);
				(point.state.scalar(PowerElastic::plasticStrain) > before ? ofFlow : ofElastic).push_back(error);
			}
		}
		for (const auto& errors : { ofElastic, ofFlow }) {
			EXPECT_GT(errors.size(), 100u);
			EXPECT_GT(partBelow(errors, 3 * tangentFloor), .9); // tangentFloor: part of the elastic stiffness that is left on edges
			EXPECT_GT(partBelow(errors, 1e-6), .95);            // the others have a corner of the law between the points of a difference
		}
	}
	TEST(PowerElastic, AnswersWithItsTangentOnThePyramid)
	{
		expectTangents([](Random& random, int k) {
			const double phi = random.in(.2, .7);
			return withMohrCoulomb(random.in(.2, .8), random.in(1e3, 20e3), phi, k % 2 ? 0 : phi, k % 3 ? 1e9 : random.in(0, 2e3));
		});
	}
	TEST(PowerElastic, AnswersWithItsTangentOnTheCone)
	{
		expectTangents([](Random& random, int k) {
			const double phi = random.in(.2, .7);
			return withDruckerPrager(random.in(.2, .8), random.in(1e3, 20e3), phi, k % 2 ? 0 : phi);
		});
	}

	// Strength is that of the law without the power, and so is the elastic strain's share: in triaxial compression.
	TEST(PowerElastic, FailsAtMohrCoulombsStrength)
	{
		const double          phi = .6, c = 2e3, k = (1 + std::sin(phi)) / (1 - std::sin(phi));
		Element<PowerElastic> point(withMohrCoulomb(.5, c, phi, .1));
		point.press(Vec3::Constant(100e3));
		for (int step = 0; step < 40; ++step)
			point.compress(1e-3, 100e3);
		EXPECT_NEAR(-point.stress(1, 1) / (k * 100e3 + 2 * c * std::sqrt(k)), 1, 1e-8);
		const double sine = std::sin(.1), volume = point.volume;
		point.compress(1e-3, 100e3);
		EXPECT_NEAR(point.volume - volume, 1e-3 * 2 * sine / (1 - sine), 1e-9); // the elastic strain stays
	}

	TEST(PowerElastic, AssociatedFlowIsSymmetric)
	{
		Random                random(7);
		Element<PowerElastic> point(withDruckerPrager(.5, 5e3, .5, .5));
		ASSERT_TRUE(point.law.isSymmetric());
		point.press(Vec3::Constant(50e3));
		const Mandel D = point.ask(symmetric(random, 5e-3)).tangent;
		EXPECT_LT((D - D.transpose()).norm(), 1e-9 * D.norm());
	}

} // namespace
} // namespace gimpm::testPowerElastic
