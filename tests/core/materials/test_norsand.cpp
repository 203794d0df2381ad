// SPDX-License-Identifier: GPL-2.0-or-later
// NorSand against another implementation's numbers, its critical state, its tangent, and steps of any size.
#include "core/materials/norsand.hpp"
#include "element.hpp"
#include <Eigen/LU>
#include <algorithm>

namespace gimpm::testNorSand {
namespace {

	constexpr double p0 = 390e3, M = 1.27, lambda = .02, criticalVolume = 1.8911, v0 = 1.75;

	/// beta = (1 - N) / (1 - N of the potential).
	NorSand sand(double N, double beta = 1, double volume = v0)
	{
		return NorSand({ 45e6, .0015, p0, M, lambda, criticalVolume, 1e3, N, 1 - (1 - N) / beta, 70, volume, -3.5 });
	}

	TEST(NorSand, StressByNumbers)
	{
		struct Case {
			double N, beta;
			Vec3   stress;
			double image;
		};
		for (const Case& c : { Case { .4, 1, { -466248.1324, -535500.2055, -783653.4674 }, 354816.2215 },
		                       Case { 0, 1, { -522655.3329, -577248.7315, -772875.0766 }, 306127.5499 },
		                       Case { .4, .7, { -525717.0536, -587246.1713, -807725.5098 }, 364380.6590 } }) {
			Element<NorSand> point(sand(c.N, c.beta));
			point.state.scalar(NorSand::imagePressure) = 715e3 * (c.N > 0 ? std::pow(1 - c.N, (1 - c.N) / c.N) : std::exp(-1.));
			point.apply(Vec3(1.5e-3, .3e-3, -4e-3));
			EXPECT_LT((Vec3(point.stress.diagonal()) - c.stress).cwiseAbs().maxCoeff(), 1e-3);
			EXPECT_NEAR(point.state.scalar(NorSand::imagePressure), c.image, 1e-3);
			EXPECT_NEAR(point.state.scalar(NorSand::specificVolume), v0 * std::exp(-2.2e-3), 1e-12);
		}
	}

	// Q / P is that of the critical state long before P is.
	TEST(NorSand, UndrainedShearLeadsToTheCriticalState)
	{
		for (const double N : { 0., .4 }) {
			Element<NorSand> point(sand(N));
			point.press(Vec3::Constant(p0));
			for (int step = 0; step < 2000; ++step)
				point.apply(Vec3(Vec3(.5, -1, .5) * 4. / 2000));
			EXPECT_NEAR(point.difference() / point.pressure(), M, 2e-3 * M) << N;
			// On its way to exp((vc - v) / lambda) = 1159 kPa
			EXPECT_GT(point.pressure(), 1.2 * p0);
			EXPECT_LT(point.pressure(), 1e3 * std::exp((criticalVolume - v0) / lambda));
		}
	}

	TEST(NorSand, DenseSandPeaksAndDilatesAndLooseSandDoesNot)
	{
		const auto sheared = [](double volume) {
			Element<NorSand>    point(sand(.3, 1, volume));
			std::vector<double> q;
			point.press(Vec3::Constant(100e3));
			for (int step = 0; step < 300; ++step) {
				point.compress(1e-3, 100e3);
				q.push_back(point.difference());
			}
			return std::make_pair(q, point.volume);
		};
		const auto [dense, swollen] = sheared(1.65);
		const auto [loose, shrunk]  = sheared(1.85);
		EXPECT_GT(*std::max_element(dense.begin(), dense.end()), 1.1 * dense.back());
		EXPECT_GT(swollen, .02);
		EXPECT_LT(*std::max_element(loose.begin(), loose.end()), 1.01 * loose.back());
		EXPECT_LT(shrunk, 0);
	}

	TEST(NorSand, BearsTheStressThatItIsMadeFor)
	{
		Random random(8);
		for (int k = 0; k < 50; ++k) {
			Element<NorSand> point(sand(k % 2 ? 0 : .4));
			point.press(random.in(10e3, 300e3) * Vec3(random.in(.5, .9), 1, random.in(.5, .9)));
			const Mat3 stress = point.stress;
			point.apply(Mat3(Mat3::Zero()));
			EXPECT_LT((point.stress - stress).norm(), 1e-8 * stress.norm());
		}
	}

	// All parts of the yield function, and its tip. Where a corner lies between the points of a difference it says
	// nothing.
	TEST(NorSand, AnswersToStepsOfAnySizeWithItsTangent)
	{
		Random              random(9);
		std::vector<double> errors;
		for (int k = 0; k < 100; ++k) {
			const double     N = k % 4 ? random.in(0, .6) : 0, ofPotential = k % 3 ? N : random.in(0, N);
			Element<NorSand> point(
			        NorSand({ random.in(20e6, 80e6), random.in(.001, .005), random.in(50e3, 350e3), random.in(1, 1.5), random.in(.01, .04),
			                  criticalVolume, 1e3, N, ofPotential, random.in(20, 170), random.in(1.6, 1.9), -3.5 }));
			point.press(Vec3::Constant(random.in(20e3, 320e3)));
			for (int i = 0; i < 30; ++i) {
				const double size = std::pow(10, random.in(-6, -3));
				Mat3         m = random.matrix<3, 3>(size), strain = (m + m.transpose()) / 2;
				strain -= (strain.trace() / 4 + .05 * size) * Mat3::Identity();
				errors.push_back(point.tangentError(strain, 1e-3, 1e5));
				point.apply(strain);
			}
		}
		EXPECT_GT(partBelow(errors, 1e-8), .9);
		EXPECT_GT(partBelow(errors, 1e-6), .99);
	}

	// Dense sand under a footing that hardens fast, and whose bulk modulus is 60 times its shear modulus: a small
	// dilation takes much of the pressure, and Newton's method from the trial does not find what it leaves.
	TEST(NorSand, AnswersToDilationOfSandThatHardensFast)
	{
		Random random(10);
		for (const double hardening : { 70., 300., 1e3, 1e4 })
			for (int k = 0; k < 100; ++k) {
				Element<NorSand> point(NorSand({ 2e6, .005, 1e3, M, lambda, 1.9, 1e3, 0, 0, hardening, 1.754, -3.5 }));
				point.press(603e3 * Vec3(1 - 1.268 / 3, 1 - 1.268 / 3, 1 + 2 * 1.268 / 3));
				const double size = std::pow(10, random.in(-5, -2));
				const Mat3   m    = random.matrix<3, 3>(size);
				EXPECT_FALSE(point.ask(Mat3((m + m.transpose()) / 2 + size / 4 * Mat3::Identity())).failed) << hardening << ' ' << size;
			}
	}

	// Loose and dense, with hardly any pressure and with much, far outside of the yield surface and beyond its tip.
	// Where loose sand softens fast, Q / P grows in the return, as P falls faster than Q.
	TEST(NorSand, HasAnAnswerToAnyStep)
	{
		Random              random(3);
		std::vector<double> errors;
		for (const double hardening : { 70., 1e3, 1e6 })
			for (const double size : { 1e-5, 1e-3, 1e-2 })
				for (int k = 0; k < 30; ++k) {
					Element<NorSand> point(NorSand({ 2e6, .005, 1e3, M, lambda, 1.9, 1e3, 0, 0, hardening, random.in(1.72, 1.95), -3.5 }));
					const double     pressure = std::pow(10, random.in(-2, 6));
					const Vec3       other = random.matrix<3>(1), deviator = other - Vec3::Constant(other.mean());
					point.press(pressure * (Vec3::Ones() + random.in(0, 1.3) / deviator.norm() * deviator));
					const Mat3 m      = random.matrix<3, 3>(size),
					           strain = (m + m.transpose()) / 2 - (m.trace() / 3 + random.in(-.3, .3) * size) * Mat3::Identity();
					ASSERT_FALSE(point.ask(strain).failed) << hardening << ' ' << size << ' ' << pressure;
					errors.push_back(point.tangentError(strain, 1e-3, 1e3));
				}
		EXPECT_GT(partBelow(errors, 1e-6), .99);
	}

	// Opening makes it looser, and need not be closed before it bears again.
	TEST(NorSand, HasNoStressWhereItComesApart)
	{
		Element<NorSand> point(sand(0));
		point.press(Vec3::Constant(10e3));
		for (int step = 0; step < 10; ++step)
			point.apply(Mat3(.001 * Mat3::Identity()));
		EXPECT_NEAR(point.pressure(), 1e-6 * p0, 1e-9);
		EXPECT_LT(point.difference(), 1e-9);
		Element<NorSand> gone = point;
		gone.apply(Mat3(.5 * Mat3::Identity())); // farther in a step than its elasticity reaches
		EXPECT_NEAR(gone.pressure(), 1e-6 * p0, 1e-9);
		for (int step = 0; step < 100; ++step)
			point.apply(Vec3(5e-4, -1.2e-3, 5e-4));
		EXPECT_GT(point.pressure(), 1e3);
	}

	TEST(NorSand, HasNoAnswerWithoutPores)
	{
		Element<NorSand> point(sand(.4, 1, 1.001));
		point.press(Vec3::Constant(p0));
		EXPECT_TRUE(point.ask(-.001 * Mat3::Identity()).failed);
	}

} // namespace
} // namespace gimpm::testNorSand
