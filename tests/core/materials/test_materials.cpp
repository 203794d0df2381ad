// SPDX-License-Identifier: GPL-2.0-or-later
// Constitutive laws in principal axes.
#include "core/materials/law.hpp"
#include "scenes.hpp"

namespace gimpm {
namespace {

	// E = 2.6, nu = 0.3: G = 1, K = 13/6, lambda = 1.5
	const Hencky   elastic(2.6, 0.3);
	const VonMises plastic(2.6, 0.3, 0.05);

	Vec3 deviator(const Vec3& v) { return v.array() - v.sum() / 3; }

	/// d stress / d trial strain by central differences.
	template <class Law> Mat3 differences(const Law& law, const Vec3& strain, double step)
	{
		Mat3 D;
		for (int j = 0; j < 3; ++j) {
			const Vec3 d = step * Vec3::Unit(j);
			D.col(j)     = (law.respond(strain + d, law.initialInternals()).stress - law.respond(strain - d, law.initialInternals()).stress)
			        / (2 * step);
		}
		return D;
	}

	/// Trial strains with a deviatoric stress of 1.2 to 120 times the yield stress, in all directions.
	std::vector<Vec3> beyondYield()
	{
		std::vector<Vec3> strains;
		Random            random;
		while (strains.size() < 100) {
			const Vec3 e = random.matrix<3>();
			if (deviator(e).norm() < 0.1) continue;
			const double rho = 0.05 * std::pow(10, random.in(std::log10(1.2), 2));
			strains.push_back(deviator(e).normalized() * rho / 2 + random.in(-0.3, 0.3) * Vec3::Ones());
		}
		return strains;
	}

	TEST(Hencky, StressByHand)
	{
		const Response r = elastic.respond(Vec3(0.1, -0.05, 0.02), {}); // volumetric strain 0.07
		EXPECT_NEAR(r.stress[0], 0.2 + 1.5 * 0.07, 1e-15);
		EXPECT_NEAR(r.stress[1], -0.1 + 1.5 * 0.07, 1e-15);
		EXPECT_NEAR(r.stress[2], 0.04 + 1.5 * 0.07, 1e-15);
		EXPECT_EQ(r.elasticStrain, Vec3(0.1, -0.05, 0.02));
	}

	TEST(Hencky, UniaxialStressDefinesItsConstants)
	{
		for (const double nu : { -0.9, 0., 0.2, 0.49 }) {
			const Response r = Hencky(5e6, nu).respond(0.01 * Vec3(-nu, 1, -nu), {});
			EXPECT_NEAR(r.stress[1], 5e4, 1e-9);
			EXPECT_NEAR(r.stress[0], 0, 1e-9);
			EXPECT_NEAR(r.stress[2], 0, 1e-9);
		}
	}

	TEST(Hencky, TangentIsTheDerivativeOfStress)
	{
		const Vec3 e(0.3, -0.2, 0.05);
		// Linear law: any step.
		EXPECT_LT((elastic.respond(e, {}).tangent - differences(elastic, e, 1e-3)).norm(), 1e-11);
		const Response r = elastic.respond(e, {});
		for (int p = 0; p < 3; ++p)
			EXPECT_NEAR(r.stress[p] - r.stress[(p + 1) % 3], 2 * r.shear[p] * (e[p] - e[(p + 1) % 3]), 1e-15);
	}

	TEST(VonMises, ElasticInsideTheYieldSurfaceAndOnIt)
	{
		// sqrt(2 J2) = 2 G |dev e| = 2 sqrt(2) 0.017 = 0.048 < 0.05
		const Vec3 e(0.4 + 0.017, 0.4 - 0.017, 0.4);
		const auto r = plastic.respond(e, { 0.1 });
		const auto h = elastic.respond(e, {});
		EXPECT_EQ(r.stress, h.stress);
		EXPECT_EQ(r.tangent, h.tangent);
		EXPECT_EQ(r.elasticStrain, e);
		EXPECT_EQ(r.internals[0], 0.1);
		EXPECT_EQ(plastic.respond(Vec3::Constant(-5), { 0 }).stress, elastic.respond(Vec3::Constant(-5), {}).stress) << "pressure alone does not yield";
	}

	TEST(VonMises, YieldStressBoundsTheRootOfTwiceJ2)
	{
		// uniaxial stress: sqrt(2 J2) = sqrt(2/3) sigma, so that it yields at sigma = sqrt(1.5) 0.05
		const double sigma = std::sqrt(1.5) * 0.05;
		const Vec3   onset = sigma / 2.6 * Vec3(1, -0.3, -0.3);
		const auto   below = plastic.respond(onset * (1 - 1e-12), { 0 }), above = plastic.respond(onset * (1 + 1e-6), { 0 });
		EXPECT_EQ(below.internals[0], 0);
		EXPECT_GT(above.internals[0], 0);
		EXPECT_NEAR(below.stress[0], sigma, 1e-12);
	}

	TEST(VonMises, ReturnEndsOnTheYieldSurface)
	{
		for (const Vec3& e : beyondYield()) {
			const Vec3 s = deviator(plastic.respond(e, { 0 }).stress);
			EXPECT_NEAR(s.norm(), 0.05, 1e-15);
			EXPECT_LT((s.normalized() - deviator(e).normalized()).norm(), 1e-13) << "radially";
		}
	}

	TEST(VonMises, ReturnLeavesTheVolumetricPart)
	{
		for (const Vec3& e : beyondYield()) {
			const auto r = plastic.respond(e, { 0 });
			EXPECT_NEAR(r.elasticStrain.sum(), e.sum(), 1e-15);
			EXPECT_NEAR(r.stress.sum(), 3 * 13. / 6 * e.sum(), 1e-14);
		}
	}

	TEST(VonMises, StressIsThatOfTheElasticStrain)
	{
		for (const Vec3& e : beyondYield()) {
			const auto r = plastic.respond(e, { 0 });
			EXPECT_LT((elastic.respond(r.elasticStrain, {}).stress - r.stress).norm(), 1e-14);
		}
	}

	TEST(VonMises, EquivalentPlasticStrainGrowsByThePlasticFlow)
	{
		for (const Vec3& e : beyondYield()) {
			const auto r = plastic.respond(e, { 0.25 });
			EXPECT_NEAR(r.internals[0], 0.25 + std::sqrt(2. / 3) * (e - r.elasticStrain).norm(), 1e-14);
		}
		// pure shear by hand: |dev e| = 0.1 sqrt(2), of which 0.05/2 remains elastic
		EXPECT_NEAR(plastic.respond(Vec3(0.1, -0.1, 0), { 0 }).internals[0], std::sqrt(2. / 3) * (0.1 * std::sqrt(2.) - 0.025), 1e-15);
	}

	TEST(VonMises, TangentIsTheDerivativeOfStress)
	{
		for (const Vec3& e : beyondYield()) {
			const Mat3 D = plastic.respond(e, { 0 }).tangent;
			// fourth-order differences (Richardson) of a function that varies over |dev e|
			const double step = 1e-3 * deviator(e).norm();
			const Mat3   fine = differences(plastic, e, step / 2), coarse = differences(plastic, e, step);
			EXPECT_LT((D - (4 * fine - coarse) / 3).norm(), 1e-10 * D.norm());
			EXPECT_LT((D - D.transpose()).norm(), 1e-15 * D.norm()) << "associated flow";
			EXPECT_LT((D * deviator(e)).norm(), 1e-14 * D.norm() * deviator(e).norm()) << "perfect plasticity";
		}
	}

	TEST(VonMises, TangentWithTwoEqualStrains)
	{
		for (const Vec3& e : { Vec3(0.1, 0.1, -0.3), Vec3(-0.2, 0.4, 0.4), Vec3(0.3, 0, 0.3) })
			EXPECT_LT((plastic.respond(e, { 0 }).tangent - differences(plastic, e, 1e-5)).norm(), 1e-8);
	}

	TEST(VonMises, SecantShearModulusRelatesDifferences)
	{
		for (const Vec3& e : beyondYield()) {
			const auto r = plastic.respond(e, { 0 });
			for (int p = 0; p < 3; ++p)
				EXPECT_NEAR(r.stress[p] - r.stress[(p + 1) % 3], 2 * r.shear[p] * (e[p] - e[(p + 1) % 3]), 1e-15);
		}
	}

	TEST(VonMises, HardeningByNumbers)
	{
		const auto r = VonMises(20e6, 0.3, 15e3, 1e6).respond(Vec3(2e-3, -1e-3, -4e-3), { 1e-4 });
		EXPECT_NEAR(r.stress[0], -37534.757, 1e-3);
		EXPECT_NEAR(r.stress[1], -50000, 1e-3);
		EXPECT_NEAR(r.stress[2], -62465.243, 1e-3);
		EXPECT_NEAR(r.internals[0], 2.62851612e-3, 1e-11);
	}

	// Hardening, softening (steepest -sqrt(6) G = -2.45), and softening to a residual yield stress; G = 1.
	const VonMises changing[]
	        = { { 2.6, 0.3, 0.05, 0.3 }, { 2.6, 0.3, 0.05, 10 }, { 2.6, 0.3, 0.05, -0.01 }, { 2.6, 0.3, 0.05, -2 }, { 2.6, 0.3, 0.05, -0.05, 0.02 } };

	TEST(VonMises, ReturnEndsOnTheYieldSurfaceOfThePlasticStrainAtItsEnd)
	{
		const double hardening[] = { 0.3, 10, -0.01, -2, -0.05 }, residual[] = { 0, 0, 0, 0, 0.02 };
		int          residuals = 0;
		for (int law = 0; law < 5; ++law)
			for (const Vec3& e : beyondYield())
				for (const double before : { 0., 0.01, 2. }) {
					const double flow     = std::max(0., 0.05 + hardening[law] * before);
					const auto   r        = changing[law].respond(e, { before });
					const double strength = std::max(residual[law], 0.05 + hardening[law] * r.internals[0]);
					const bool   yields   = 2 * deviator(e).norm() > std::max(residual[law], flow);
					if (yields) {
						EXPECT_NEAR(deviator(r.stress).norm(), strength, 1e-13 * (1 + std::abs(hardening[law]) * before));
					}
					EXPECT_NEAR(r.internals[0], before + std::sqrt(2. / 3) * (e - r.elasticStrain).norm(), 1e-13);
					residuals += strength == 0.02;
				}
		EXPECT_GT(residuals, 50);
	}

	TEST(VonMises, TangentOfChangingStrengthIsTheDerivativeOfStress)
	{
		int compared = 0;
		for (const VonMises& law : changing)
			for (const Vec3& e : beyondYield()) {
				const auto   r    = law.respond(e, { 0 });
				const double step = 1e-3 * deviator(e).norm();
				const Mat3   fine = differences(law, e, step / 2), coarse = differences(law, e, step);
				// The residual yield stress is reached between: a kink.
				if ((fine - coarse).norm() > 1e-4 * fine.norm()) continue;
				++compared;
				EXPECT_LT((r.tangent - (4 * fine - coarse) / 3).norm(), 1e-9 * r.tangent.norm());
				EXPECT_LT((r.tangent - r.tangent.transpose()).norm(), 1e-15 * r.tangent.norm()) << "associated flow";
			}
		EXPECT_GT(compared, 480);
	}

	TEST(Material, KnowsYoungsModulusOfItsLaw)
	{
		EXPECT_EQ((Material { Hencky(5, 0.1), 1 }).young({}, 0), 5);
		EXPECT_EQ((Material { VonMises(7, 0.1, 3), 1 }).young({}, 0), 7);
	}

} // namespace
} // namespace gimpm
