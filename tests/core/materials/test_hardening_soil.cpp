// SPDX-License-Identifier: GPL-2.0-or-later
// Hardening soil: the tests that its parameters are named after, its tangent, and steps of any size.
#include "core/materials/hardening_soil_small.hpp"
#include "element.hpp"
#include <Eigen/LU>
#include <algorithm>

namespace gimpm::testHardeningSoil {
namespace {

	constexpr double degree = M_PI / 180, pRef = 100e3, E50 = 30e6, Eoed = 30e6, Eur = 90e6, nu = .2;
	using Soil = HardeningSoil;

	Soil::Given sand(double dilation = 5)
	{
		return { E50, Eoed, Eur, nu, .5, .9, 1 - std::sin(35 * degree), pRef, 0, 35 * degree, dilation * degree, infinity };
	}

	/// Deviator stress q at an axial strain in drained triaxial compression under the reference pressure.
	double hyperbola(double strain, const Soil::Given& g)
	{
		const double sine = std::sin(g.frictionAngle), strength = 2 * sine / (1 - sine) * (g.reference + g.cohesion / std::tan(g.frictionAngle));
		const double initial = 2 * g.secant / (2 - g.failureRatio), q = strain * initial / (1 + strain * initial * g.failureRatio / strength);
		return std::min(q, strength);
	}

	TEST(HardeningSoil, DrainedTriaxialCompressionIsTheHyperbola)
	{
		for (const double dilation : { 0., 5., 12. })
			for (const double cohesion : { 0., 10e3 }) {
				auto given     = sand(dilation);
				given.cohesion = cohesion;
				Element<Soil> soil { Soil(given) };
				soil.press(Vec3::Constant(pRef));
				soil.state.scalar(Soil::capPressure) = 1e3 * pRef; // out of reach
				constexpr int steps                  = 100;
				for (int step = 1; step <= steps; ++step) {
					soil.compress(.02 / steps, pRef);
					const double q = hyperbola(.02 * step / steps, given);
					ASSERT_NEAR(soil.difference(), q, 1e-6 * q) << dilation << " " << step;
				}
			}
	}

	TEST(HardeningSoil, SecantModulusAtHalfOfTheStrengthGoesWithThePressure)
	{
		for (const double pressure : { 50e3, 400e3 }) {
			Element<Soil> soil { Soil(sand()) };
			soil.press(Vec3::Constant(pressure));
			soil.state.scalar(Soil::capPressure) = 1e8;
			const double sine = std::sin(35 * degree), half = sine / (1 - sine) * pressure, expected = E50 * std::sqrt(pressure / pRef);
			soil.compress(half / expected, pressure);
			EXPECT_NEAR(soil.difference(), half, 1e-6 * half);
		}
	}

	/// Along y, without strain across, from little stress to a vertical pressure.
	Element<Soil> consolidated(const Soil::Given& given, double pressure, double step = 1e-5)
	{
		Element<Soil> soil { Soil(given) };
		soil.press(10e3 * Vec3(given.restRatio, 1, given.restRatio));
		while (-soil.stress(1, 1) < pressure)
			soil.apply(Vec3(0, -step, 0));
		return soil;
	}

	TEST(HardeningSoil, FirstLoadingAtRestHasItsModulusAndItsRatio)
	{
		for (const double pressure : { 50e3, 100e3, 200e3 }) {
			Element<Soil> soil   = consolidated(sand(), pressure);
			const double  before = soil.stress(1, 1);
			soil.apply(Vec3(0, -1e-5, 0));
			const double modulus = (before - soil.stress(1, 1)) / 1e-5;
			EXPECT_NEAR(modulus, Eoed * std::sqrt(pressure / pRef), .005 * modulus) << pressure;
			EXPECT_NEAR(soil.stress(0, 0) / soil.stress(1, 1), sand().restRatio, .005) << pressure;
		}
	}

	TEST(HardeningSoil, UnloadsWithItsModulus)
	{
		Element<Soil> soil { Soil(sand()) };
		soil.press(Vec3::Constant(pRef));
		for (int step = 0; step < 20; ++step)
			soil.compress(5e-4, pRef);
		const double before = soil.difference();
		soil.compress(-5e-4, pRef);
		EXPECT_NEAR(before - soil.difference(), 5e-4 * Eur, 1e-6 * before);
		soil.compress(4e-4, pRef);
		EXPECT_NEAR(before - soil.difference(), 1e-4 * Eur, 1e-6 * before);
	}

	// Loose soil, which the cap contracts: its pressure falls until it fails, in compression along y, at the
	// strength of that pressure.
	TEST(HardeningSoil, UndrainedPathEndsAtTheStrengthOfItsPressure)
	{
		Element<Soil> soil { Soil(sand(0)) };
		soil.press(Vec3::Constant(pRef));
		for (int step = 0; step < 400; ++step)
			soil.apply(Vec3(1e-4, -2e-4, 1e-4));
		const double sine = std::sin(35 * degree);
		EXPECT_LT(soil.pressure(), .9 * pRef);
		EXPECT_NEAR(soil.difference() / soil.pressure(), 6 * sine / (3 - sine), 1e-6);
		// Without dilation and contraction at failure nothing changes.
		const double strength = soil.difference();
		soil.apply(Vec3(1e-3, -2e-3, 1e-3));
		EXPECT_NEAR(soil.difference(), strength, 1e-6 * strength);
	}

	// Nothing but the cap, which flows along the axis of pressure.
	TEST(HardeningSoil, IsotropicCompressionIsPlasticBeyondTheCapOnly)
	{
		Element<Soil> soil { Soil(sand()) };
		soil.press(Vec3::Constant(pRef));
		const double bulk = Eur / (3 * (1 - 2 * nu));
		soil.apply(Vec3(Vec3::Constant(1e-5 / 3)));
		EXPECT_NEAR(pRef - soil.pressure(), 1e-5 * bulk, 1e-5 * pRef * 1e-3);
		const double before = soil.pressure();
		soil.apply(Vec3(Vec3::Constant(-3e-5 / 3)));
		EXPECT_LT(soil.pressure() - before, .9 * 3e-5 * bulk);
		EXPECT_NEAR(soil.state.scalar(Soil::capPressure), soil.pressure(), 1e-6 * pRef);
		EXPECT_EQ(soil.state.scalar(Soil::shearHardening), 0);
	}

	TEST(HardeningSoil, DilatesAsRoweSaysUpToTheCutOff)
	{
		auto given         = sand(10);
		given.mostDilation = .015;
		Element<Soil> soil { Soil(given) };
		soil.press(Vec3::Constant(pRef));
		soil.state.scalar(Soil::capPressure) = 1e8;
		double fastest = 0, after = 0;
		for (int step = 0; step < 800; ++step) {
			const double before = soil.volume;
			soil.compress(1e-4, pRef);
			(before < given.mostDilation ? fastest : after) = (soil.volume - before) / 1e-4;
		}
		// Dilation by the angle of triaxial compression: 2 sin(psi) / (1 - sin(psi)) of the axial strain.
		const double sine = std::sin(10 * degree);
		EXPECT_NEAR(fastest, 2 * sine / (1 - sine), 1e-3);
		EXPECT_NEAR(after, 0, 1e-6);
	}

	Soil::Given randomSoil(Random& random, int k)
	{
		auto given     = sand(random.in(0, 15));
		given.cohesion = k % 3 ? random.in(0, 20e3) : 0;
		given.power    = k % 7 == 0 ? 1 : k % 11 == 0 ? 0 : random.in(0, 1);
		// E50 may be too small for the modulus of the oedometer.
		given.oedometric = std::min(Eoed, .9 * Soil::largestOedometric(given));
		return given;
	}
	Mat3 randomStrain(Random& random, double size)
	{
		const Mat3 m = random.matrix<3, 3>(size);
		return (m + m.transpose()) / 2 - random.in(0, .3) * size * Mat3::Identity();
	}

	// All surfaces, their corners and the apex. Where a corner lies between the points of a difference it says
	// nothing.
	TEST(HardeningSoil, TangentAgainstDifferencesOnRandomPaths)
	{
		Random              random(3);
		std::vector<double> errors;
		for (int k = 0; k < 60; ++k) {
			Element<Soil> soil { Soil(randomSoil(random, k)) };
			soil.press(Vec3::Constant(random.in(1e3, 200e3)));
			for (int i = 0; i < 30; ++i) {
				const Mat3 strain = randomStrain(random, std::pow(10, random.in(-5, -3)));
				errors.push_back(soil.tangentError(strain, 1e-3, 1e-2 * Eur));
				soil.apply(strain);
			}
		}
		EXPECT_GT(partBelow(errors, 1e-8), .85);
		EXPECT_GT(partBelow(errors, 1e-6), .97);
	}

	TEST(HardeningSoil, AnswersToStepsOfAnySizeWithinItsStrength)
	{
		Random random(4);
		for (int k = 0; k < 300; ++k) {
			const auto    given = randomSoil(random, k);
			Element<Soil> soil { Soil(given) };
			soil.press(Vec3::Constant(random.in(1e3, 200e3)));
			const double sine = std::sin(given.frictionAngle), shift = given.cohesion / std::tan(given.frictionAngle);
			for (int i = 0; i < 60; ++i) {
				soil.apply(randomStrain(random, std::pow(10, random.in(-6, -2))));
				const Vec3   t        = principal(SymTensor<3>::from(soil.stress)).value;
				const double smallest = shift - t.maxCoeff(), largest = shift - t.minCoeff(),
				             size = soil.pressure() + soil.difference() + given.cohesion;
				ASSERT_GE(smallest, -1e-8 * std::abs(size)) << k << " " << i;
				ASSERT_LE(largest - smallest, sine * (largest + smallest) + 1e-8 * std::abs(size)) << k << " " << i;
			}
		}
	}

	// The stress that a state is given is that of the next answer.
	TEST(HardeningSoil, BearsTheStressThatItIsMadeFor)
	{
		Random random(8);
		for (int k = 0; k < 50; ++k) {
			Element<Soil> soil { Soil(sand()) };
			soil.press(random.in(10e3, 300e3) * Vec3(random.in(.4, .8), 1, random.in(.4, .8)));
			const Mat3 stress = soil.stress, strain = soil.elasticStrain;
			soil.apply(Mat3(Mat3::Zero()));
			EXPECT_LT((soil.stress - stress).norm(), 1e-9 * stress.norm());
			EXPECT_LT((soil.elasticStrain - strain).norm(), 1e-9 * strain.norm());
		}
	}

	TEST(HardeningSoil, SaysWhichModulusOfTheOedometerThereCanBe)
	{
		auto given       = sand();
		given.oedometric = .99 * Soil::largestOedometric(given);
		EXPECT_GT(given.oedometric, Eoed);
		Element<Soil> soil   = consolidated(given, pRef);
		const double  before = soil.stress(1, 1);
		soil.apply(Vec3(0, -1e-5, 0));
		EXPECT_NEAR((before - soil.stress(1, 1)) / 1e-5, given.oedometric, .01 * given.oedometric);
		EXPECT_NEAR(Soil::leastRestRatio(given), (1 - std::sin(35 * degree)) / (1 + std::sin(35 * degree)), 1e-12);
	}

	constexpr double G0 = 150e6, gamma07 = 1e-4;
	using SmallSoil = HardeningSoilSmall;

	/// Sheared at constant volume; elastic, as its hardening is out of reach.
	Element<SmallSoil> elasticSoil(double cohesion = 0)
	{
		auto given     = sand();
		given.power    = 0; // the smallest pressure changes
		given.cohesion = cohesion;
		Element<SmallSoil> soil { SmallSoil(given, G0, gamma07) };
		soil.press(Vec3::Constant(pRef));
		soil.state.scalar(Soil::capPressure)    = 1e8;
		soil.state.scalar(Soil::shearHardening) = 1;
		return soil;
	}
	Vec3 sheared(double strain) { return Vec3(strain / 3, -2 * strain / 3, strain / 3); }

	TEST(HardeningSoilSmall, ModulusFallsWithTheStrainAndIsRestoredWhereItTurns)
	{
		const double G = Eur / (2 * (1 + nu)), last = gamma07 / .385 * (std::sqrt(G0 / G) - 1);
		for (const int steps : { 3, 30 }) { // however many there are
			auto soil = elasticSoil();
			for (int step = 0; step < steps; ++step)
				soil.apply(sheared(1e-4 / steps));
			EXPECT_NEAR((soil.stress(0, 0) - soil.stress(1, 1)) / 2e-4, G0 / 1.385, 1e-6 * G0);
			for (int step = 0; step < steps; ++step)
				soil.apply(sheared((last - 1e-4) / steps));
			const double before = soil.stress(0, 0) - soil.stress(1, 1);
			soil.apply(sheared(1e-4));
			EXPECT_NEAR((soil.stress(0, 0) - soil.stress(1, 1) - before) / 2e-4, G, 1e-6 * G0);
		}
		auto soil = elasticSoil();
		for (int step = 0; step < 10; ++step)
			soil.apply(sheared(5e-5));
		const double before = soil.stress(0, 0) - soil.stress(1, 1);
		soil.apply(sheared(-1e-7));
		EXPECT_NEAR((soil.stress(0, 0) - soil.stress(1, 1) - before) / -2e-7, G0, 1e-3 * G0);
	}

	// Axes of the strain are those of the step.
	TEST(HardeningSoilSmall, TangentAgainstDifferences)
	{
		Random              random(6);
		std::vector<double> errors;
		for (int k = 0; k < 30; ++k) {
			Element<SmallSoil> soil { SmallSoil(sand(), G0, gamma07) };
			soil.press(Vec3::Constant(random.in(10e3, 200e3)));
			for (int i = 0; i < 30; ++i) {
				const double size   = std::pow(10, random.in(-5.5, -3.5));
				const Vec3   strain = random.matrix<3>(size) - .3 * size * Vec3::Ones();
				Mat3         differences;
				const double h = 1e-3 * size;
				for (int c = 0; c < 3; ++c) {
					const auto at = [&](double s) {
						return Vec3(soil.ask(Mat3(Vec3(strain + s * h * Vec3::Unit(c)).asDiagonal())).stress.diagonal());
					};
					differences.col(c) = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
				}
				const auto answer = soil.ask(Mat3(strain.asDiagonal()));
				errors.push_back((differences - answer.tangent.topLeftCorner<3, 3>()).norm() / differences.norm());
				soil.apply(strain);
			}
		}
		EXPECT_GT(partBelow(errors, 1e-7), .9);
		EXPECT_GT(partBelow(errors, 1e-5), .97);
	}

	/// A step at an angle to the strain so far, in the plane of the deviators.
	Vec3 turned(double angle, double size)
	{
		const Vec3 along = Vec3(1, -2, 1) / std::sqrt(6), across = Vec3(1, 0, -1) / std::sqrt(2);
		return size * (std::cos(angle) * along + std::sin(angle) * across);
	}

	// Newton's method asks for steps on both sides of a turn.
	TEST(HardeningSoilSmall, StressHasNoJumpWhereStrainTurns)
	{
		constexpr double size = 1e-4, apart = 1e-3;
		auto             soil = elasticSoil();
		for (int step = 0; step < 5; ++step)
			soil.apply(sheared(1e-4));
		const double full = 2 * G0 * size;
		double       last = 0;
		for (double angle = 0; angle <= M_PI; angle += apart) {
			const Mat3 stress   = soil.ask(Mat3(turned(angle, size).asDiagonal())).stress,
			           near     = soil.ask(Mat3(turned(angle + apart, size).asDiagonal())).stress;
			const double change = (near - stress).norm() / full;
			ASSERT_LT(change, 3 * apart) << angle;
			const double secant = (stress - soil.stress).norm() / full;
			ASSERT_GE(secant, last - 1e-6) << angle; // the more it leads back, the stiffer
			last = secant;
		}
		EXPECT_NEAR(last, 1 / (1 + .385 * std::sqrt(1.5) * size / gamma07), 1e-6);
	}

	// Beside a spring that is not isotropic, as the body around a point is: which way the strain of the point turns
	// depends on the modulus that it has then, and with a jump of it there are forces that no strain bears.
	TEST(HardeningSoilSmall, NewtonsMethodFindsTheStrainThatBearsAForceInFewIterations)
	{
		Random random(12);
		int    most = 0;
		for (int k = 0; k < 400; ++k) {
			auto soil = elasticSoil(1e6); // never fails
			for (int i = 0; i < 3; ++i)
				soil.apply(randomStrain(random, std::pow(10, random.in(-5, -3))));
			const Mandel root = random.matrix<6, 6>(1), spring = G0 * root * root.transpose();
			const auto   both = [&](const Vec6& strain) {
                                const auto answer = soil.ask(fromMandel(strain));
                                return std::make_pair(Vec6(toMandel(Mat3(answer.stress - soil.stress)) + spring * strain), Mandel(answer.tangent + spring));
			};
			const double length = std::pow(10, random.in(-6, -3));
			const Vec6   wanted = both(toMandel(randomStrain(random, length))).first + both(toMandel(randomStrain(random, length))).first;
			Vec6         strain = Vec6::Zero();
			int          needed = 0;
			for (double part = 1; part > 1e-9 && needed < 50; ++needed) {
				const auto [stress, tangent] = both(strain);
				part                         = (stress - wanted).norm() / wanted.norm();
				strain -= tangent.partialPivLu().solve(stress - wanted);
			}
			most = std::max(most, needed);
		}
		EXPECT_LE(most, 12);
	}

} // namespace
} // namespace gimpm::testHardeningSoil
