// SPDX-License-Identifier: GPL-2.0-or-later
// Modified Cam clay.
#include "scenes.hpp"
#include "soil.hpp"
#include <cstdio>

namespace gimpm::soil::testCamClay {
namespace {

	constexpr double M = 1.2, lambda = 0.1, kappa = 0.03, G = 5e6, p0 = 1e5;
	const CamClay    clay(G, M, lambda, kappa, p0, p0);

	struct Invariants {
		double P, Q;

		explicit Invariants(const Vec3& stress) : P(-stress.mean()), Q(std::sqrt(1.5) * deviator(stress).norm()) { }
		double surface(double pc) const { return Q * Q / (M * M) + P * (P - pc); }
	};

	/// Trial strains from a point under the reference pressure, whose preconsolidation pressure is `ratio` times
	/// that.
	std::vector<Vec3> strains(int count, double size)
	{
		std::vector<Vec3> all;
		Random            random(5);
		for (int i = 0; i < count; ++i) {
			const double scale = size * std::pow(10, random.in(-2, 0));
			Vec3         e     = random.matrix<3>(scale) + random.in(-scale, scale) * Vec3::Ones();
			if (i % 4 == 0) e[i % 3] = e[(i + 1) % 3];
			all.push_back(e);
		}
		return all;
	}

	TEST(CamClay, StressByNumbers)
	{
		const auto r = respondTo(clay, Vec3(1e-3, -10e-3, -30e-3));
		EXPECT_LT((r.stress - Vec3(-115248.20, -134572.23, -169706.84)).cwiseAbs().maxCoeff(), 5e-3);
		EXPECT_NEAR(r.internals[1], 151198.4637, 5e-5);
		EXPECT_EQ(r.failed, 0);
	}

	TEST(CamClay, ElasticPressureIsAnExponential)
	{
		const CamClay strong(G, M, lambda, kappa, 1e7, p0);
		const Vec3    e(-0.01, -0.02, 0.005);
		const auto    r = respondTo(strong, e);
		EXPECT_NEAR(Invariants(r.stress).P, p0 * std::exp(0.025 / kappa), 1e-9);
		EXPECT_LT((deviator(r.stress) - 2 * G * deviator(e)).norm(), 1e-9);
		EXPECT_EQ(r.elasticStrain, e);
		EXPECT_EQ(r.internals[0], 0);
		EXPECT_EQ(r.internals[1], 1e7);
		EXPECT_LT((strong.strainOf(r.stress) - e).norm(), 1e-16);
	}

	TEST(CamClay, YoungsModulusGoesWithThePressureAndHasAFloor)
	{
		const auto of = [](double pressure) { return 9 * pressure / kappa * G / (3 * pressure / kappa + G); };
		EXPECT_NEAR(clay.young({ 0, p0 }, 0), of(p0), 1e-6);
		EXPECT_NEAR(clay.young({ 0, p0 }, -0.03), of(p0 * std::exp(1.)), 1e-6);
		EXPECT_NEAR(clay.young({ 0, 4e5 }, 1), of(400), 1e-9);
	}

	TEST(CamClay, ReturnEndsOnTheYieldSurfaceItHardensTo)
	{
		for (const double size : { 0.01, 0.2 })
			for (const Vec3& e : strains(1000, size)) {
				const auto r = respondTo(clay, e);
				ASSERT_EQ(r.failed, 0) << e.transpose();
				const Invariants t(r.stress);
				const double     pc = r.internals[1];
				EXPECT_LE(t.surface(pc), 1e-12 * (pc * pc + t.Q * t.Q));
				EXPECT_NEAR(std::log(pc / p0), (r.elasticStrain - e).sum() / (lambda - kappa), 1e-11);
				EXPECT_NEAR(t.P / (p0 * std::exp(-r.elasticStrain.sum() / kappa)), 1, 1e-11);
				EXPECT_LT((deviator(r.stress) - 2 * G * deviator(r.elasticStrain)).norm(), 1e-12 * (G * e.norm() + p0));
				EXPECT_NEAR(r.internals[0], std::sqrt(2. / 3) * deviator(e - r.elasticStrain).norm(), 1e-14);
				for (int p = 0; p < 3; ++p)
					EXPECT_NEAR(r.stress[p] - r.stress[(p + 1) % 3], 2 * r.shear[p] * (e[p] - e[(p + 1) % 3]), 1e-12 * (t.P + t.Q));
			}
	}

	// Plastic strain is normal to the yield surface: its parts go as 2 P - pc and 2 Q / M^2.
	TEST(CamClay, FlowIsAssociated)
	{
		int flowing = 0;
		for (const Vec3& e : strains(500, 0.1)) {
			const auto       r = respondTo(clay, e);
			const Invariants t(r.stress);
			if (r.internals[1] == p0) continue;
			++flowing;
			const double volumetric = (r.elasticStrain - e).sum(), shear = r.internals[0], dP = 2 * t.P - r.internals[1], dQ = 2 * t.Q / (M * M);
			EXPECT_NEAR(volumetric * dQ, shear * dP, 1e-9 * e.norm() * (std::abs(dP) + dQ));
			EXPECT_GE(volumetric * dP + shear * dQ, 0);
		}
		EXPECT_GT(flowing, 100);
	}

	TEST(CamClay, TangentIsTheDerivativeOfStress)
	{
		int compared = 0, dry = 0;
		for (const Vec3& e : strains(1000, 0.05)) {
			const auto   r    = respondTo(clay, e);
			const double step = 3e-4 * kappa;
			const Mat3   fine = stressDifferences(clay, e, step / 2), coarse = stressDifferences(clay, e, step);
			if ((fine - coarse).norm() > 1e-4 * fine.norm()) continue;
			++compared;
			dry += r.internals[1] < p0;
			EXPECT_LT((r.tangent - (4 * fine - coarse) / 3).norm(), 1e-6 * r.tangent.norm()) << e.transpose();
		}
		EXPECT_GT(compared, 900);
		EXPECT_GT(dry, 100);
	}

	TEST(CamClay, TangentOfFiniteStepsIsNotSymmetric)
	{
		const Mat3 D = respondTo(clay, Vec3(1e-3, -10e-3, -30e-3)).tangent;
		EXPECT_GT((D - D.transpose()).norm(), 1e-3 * D.norm());
		EXPECT_FALSE(clay.isSymmetric());
	}

	// Pressures and shear stresses of twenty times the yield surface and far more, wet and dry, and under tension.
	TEST(CamClay, ConvergesFromFarOutside)
	{
		Random random(7);
		for (int i = 0; i < 20000; ++i) {
			const CamClay law(G, random.in(0.5, 1.8), lambda, lambda * random.in(0.02, 0.95), p0 * std::pow(10, random.in(-2, 2)), p0);
			const double  times    = std::pow(10, random.in(-4, 2.5));
			const Vec3    n        = deviator(random.matrix<3>()).normalized();
			const double  pressure = p0 * times, stress = std::pow(10, random.in(-3, 2)) * 20 * p0;
			const Vec3    e = law.strainOf(-pressure * Vec3::Ones() + stress * n);
			const auto    r = respondTo(law, e);
			ASSERT_EQ(r.failed, 0) << e.transpose();
			ASSERT_TRUE(r.stress.allFinite() && r.tangent.allFinite());
			ASSERT_GT(r.internals[1], 0);
			ASSERT_LT((law.strainOf(r.stress) - r.elasticStrain).norm(), 1e-10 * (kappa + e.norm()));
		}
	}

	TEST(CamClay, FailsAsAValue)
	{
		for (const Vec3& e : { Vec3(2, 2, 2), Vec3(-2, -2, -2), Vec3(NAN, 0, 0), Vec3(0, infinity, 0) })
			EXPECT_EQ(respondTo(clay, e).failed, 1) << e.transpose();
		EXPECT_EQ(clay.respond(Vec3::Zero(), { 0., 0. }).failed, 1) << "no preconsolidation pressure";
	}

	TEST(CamClay, RoundOffDoesNotDecideWhetherItYields)
	{
		expectContinuousOverBoundaries(clay, 1e7, strains(400, 0.02));
		for (const Vec3& e : strains(200, 0.02)) {
			const auto returned = respondTo(clay, e);
			const auto again    = clay.respond(returned.elasticStrain, returned.internals);
			EXPECT_LT((again.stress - returned.stress).norm(), 1e-9);
			const double bulk = Invariants(again.stress).P / kappa;
			EXPECT_NEAR(again.tangent.sum(), 9 * bulk, 1e-6 * bulk) << "elastic";
		}
	}

	TEST(CamClay, InLanesAsByItself) { expectSameInLanes(clay, strains(400, 0.05), 1e7); }

	/// Follows increments of strain, of which lateral(r, trial) may change those along x and y.
	template <class Lateral> auto path(const CamClay& law, double pressure, const Vec3& increment, int steps, Lateral&& lateral)
	{
		Vec3 strain    = law.strainOf(Vec3::Constant(-pressure));
		auto internals = law.initialInternals();
		auto r         = law.respond(strain, internals);
		for (int step = 0; step < steps; ++step) {
			const auto answer = [&](double along) { return law.respond(Vec3(strain + increment + along * Vec3(1, 1, 0)), internals); };
			r                 = lateral(answer);
			strain = r.elasticStrain, internals = r.internals;
		}
		return r;
	}
	template <class Answer> auto undrained(const Answer& answer) { return answer(0); }

	// Undrained: p_f = p0 (OCR / 2)^(1 - kappa / lambda), q_f = M p_f, exact for this elasticity.
	TEST(CamClay, UndrainedStrength)
	{
		for (const double overconsolidation : { 1., 2., 5., 20. }) {
			const CamClay    law(G, M, 0.1, 0.02, overconsolidation * p0, p0);
			const auto       r = path(law, p0, Vec3(0.5, 0.5, -1) * 1e-3, 800, [](const auto& answer) { return undrained(answer); });
			const Invariants t(r.stress);
			const double     expected = p0 * std::pow(overconsolidation / 2, 0.8);
			EXPECT_NEAR(t.P, expected, 1e-4 * expected);
			EXPECT_NEAR(t.Q, M * expected, 1e-4 * expected);
			std::printf("OCR %g: p_f / p0 = %.6f\n", overconsolidation, t.P / p0);
		}
	}

	// Drained from p0: p_f = 3 p0 / (3 - M), q_f = M p_f.
	TEST(CamClay, DrainedStrength)
	{
		const auto kept = [](const auto& answer) {
			double from = -1e-2, to = 1e-2;
			for (int half = 0; half < 60; ++half) {
				const double middle                          = 0.5 * (from + to);
				(answer(middle).stress[0] < -p0 ? from : to) = middle;
			}
			return answer(from);
		};
		const auto       r = path(CamClay(G, M, 0.1, 0.02, p0, p0), p0, Vec3(0, 0, -1e-3), 1500, kept);
		const Invariants t(r.stress);
		EXPECT_NEAR(t.P, 3 * p0 / (3 - M), 100);
		EXPECT_NEAR(t.Q, M * 3 * p0 / (3 - M), 300);
	}

	// Compression: along the line of slope lambda beyond the preconsolidation pressure, of slope kappa before and
	// in unloading.
	TEST(CamClay, CompressionFollowsItsLines)
	{
		const CamClay law(G, M, lambda, kappa, 3 * p0, p0);
		const double  toYield = kappa * std::log(3.);
		const auto    r       = respondTo(law, Vec3::Constant(-(toYield + lambda * std::log(2.)) / 3));
		EXPECT_NEAR(Invariants(r.stress).P, 6 * p0, 1e-6);
		EXPECT_NEAR(r.internals[1], 6 * p0, 1e-6);
		const auto unloaded = law.respond(Vec3(r.elasticStrain + Vec3::Constant(kappa / 3)), r.internals);
		EXPECT_NEAR(Invariants(unloaded.stress).P, 6 * p0 / std::exp(1.), 1e-6);
		EXPECT_EQ(unloaded.internals, r.internals);
	}

	// No work is left by a closed cycle within the yield surface.
	TEST(CamClay, ElasticCyclesKeepTheEnergy)
	{
		const CamClay law(G, M, lambda, kappa, 1e7, p0);
		double        work = 0, size = 0;
		constexpr int n  = 20000;
		const auto    at = [](double s) { return Vec3(0.01 * std::cos(s) - 0.02, 0.02 * std::sin(s), 0.01 * std::cos(s + 1)); };
		for (int i = 0; i < n; ++i) {
			const Vec3   from = at(2 * M_PI * i / n), to = at(2 * M_PI * (i + 1) / n);
			const double part = respondTo(law, Vec3(0.5 * (from + to))).stress.dot(to - from);
			work += part, size += std::abs(part);
		}
		EXPECT_LT(std::abs(work), 1e-6 * size);
	}

} // namespace
} // namespace gimpm::soil::testCamClay
