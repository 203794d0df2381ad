// SPDX-License-Identifier: GPL-2.0-or-later
// Drucker and Prager's law.
#include "scenes.hpp"
#include "soil.hpp"

namespace gimpm::soil::testDruckerPrager {
namespace {

	constexpr double E = 20e6, nu = 0.3, c = 5e3;
	using Cone = DruckerPragerCone;

	/// Friction of plane strain with associated flow, whatever the dilation.
	Cone customary(double friction, double dilation)
	{
		const Cone own = Cone::planeStrain(c, friction * degree, friction * degree), flow = Cone::planeStrain(c, dilation * degree, dilation * degree);
		Cone       cone {};
		cone.frictionCoefficient = own.frictionCoefficient, cone.dilation = flow.dilation, cone.strength = own.strength;
		return cone;
	}

	struct Parameters {
		Cone   cone;
		double tension;

		DruckerPrager law() const { return { E, nu, cone, tension }; }
		double        mostMean() const { return std::min(tension, cone.frictionCoefficient > 0 ? cone.strength / cone.frictionCoefficient : infinity); }
	};
	const Parameters all[] = { { Cone::planeStrain(c, 30 * degree, 30 * degree), infinity },
		                   { Cone::planeStrain(c, 30 * degree, 0), infinity },
		                   { Cone::compression(c, 30 * degree, 10 * degree), infinity },
		                   { Cone::extension(0, 40 * degree, 5 * degree), infinity },
		                   { Cone::planeStrain(c, 0, 0), infinity },
		                   { Cone::planeStrain(c, 0, 0), 2e3 },
		                   { Cone::planeStrain(c, 30 * degree, 10 * degree), 1e3 },
		                   { Cone::planeStrain(c, 30 * degree, 30 * degree), 0 } };

	TEST(DruckerPrager, StressByNumbers)
	{
		const DruckerPrager law(E, nu, customary(30, 10));
		expectStress(law, { 2, -1, -4 }, { -24784.022, -55703.248, -86622.474 });
		expectStress(law, { 2, 1.9, 1.8 }, Vec3::Constant(c * std::sqrt(3.)));
	}

	TEST(DruckerPrager, ConstantsByFormula)
	{
		const double s = 0.5, t = std::tan(30 * degree);
		EXPECT_NEAR(Cone::compression(c, 30 * degree, 0).frictionCoefficient, 6 * s / (std::sqrt(3.) * (3 - s)), 1e-15);
		EXPECT_NEAR(Cone::compression(c, 30 * degree, 0).strength, 6 * std::cos(30 * degree) * c / (std::sqrt(3.) * (3 - s)), 1e-11);
		EXPECT_NEAR(Cone::extension(c, 30 * degree, 30 * degree).dilation, 6 * s / (std::sqrt(3.) * (3 + s)), 1e-15);
		EXPECT_NEAR(Cone::planeStrain(c, 30 * degree, 30 * degree).frictionCoefficient, 3 * t / std::sqrt(9 + 12 * t * t), 1e-15);
		EXPECT_NEAR(Cone::planeStrain(c, 30 * degree, 30 * degree).strength, 3 * c / std::sqrt(9 + 12 * t * t), 1e-11);
		EXPECT_NEAR(Cone::planeStrain(c, 30 * degree, 0).frictionCoefficient, s, 1e-15);
		EXPECT_NEAR(Cone::planeStrain(c, 30 * degree, 0).strength, c * std::cos(30 * degree), 1e-11);
	}

	TEST(DruckerPrager, IsSymmetricWithAssociatedFlow)
	{
		for (const double angle : { 0., 10., 30., 44. }) {
			for (const auto& match : { Cone::planeStrain, Cone::compression, Cone::extension }) {
				EXPECT_TRUE(DruckerPrager(E, nu, match(c, angle * degree, angle * degree)).isSymmetric());
				EXPECT_EQ(DruckerPrager(E, nu, match(c, angle * degree, 0)).isSymmetric(), angle == 0);
			}
		}
	}

	// k s3 - 2 c sqrt(k), as Mohr and Coulomb's law, at any dilation; with the customary constants 5.5 percent
	// less.
	TEST(DruckerPrager, BiaxialStrengthIsThatOfMohrAndCoulomb)
	{
		const auto strength = [](const Cone& cone) { return biaxialStrength(DruckerPrager(50e6, nu, cone), Hencky(50e6, nu), -50e3)[1]; };
		for (const double dilation : { 30., 10., 0. })
			EXPECT_NEAR(strength(Cone::planeStrain(10e3, 30 * degree, dilation * degree)), -184641, 2);
		Cone weak = customary(30, 0);
		weak.strength *= 2;
		EXPECT_NEAR(strength(weak), -174476, 2);
	}

	TEST(DruckerPrager, SimpleShearStrengthIsThatOfMohrAndCoulomb)
	{
		for (const auto& [dilation, ratio] : { std::pair { 30., 0.57735 }, std::pair { 15., 0.55475 }, std::pair { 0., 0.5 } }) {
			const DruckerPrager law(50e6, nu, Cone::planeStrain(0, 30 * degree, dilation * degree));
			EXPECT_NEAR(simpleShearStrength(law, Hencky(50e6, nu), -100e3), ratio, 2e-5);
		}
	}

	// In triaxial compression and extension a match has the strength k s3 - s.
	TEST(DruckerPrager, MatchesTheEdgesOfThePyramid)
	{
		const double k = 3, s = 2 * c * std::sqrt(3.);
		const auto   over = [&](const Cone& cone, const Vec3& t) {
                        return deviator(t).norm() / std::sqrt(2.) + cone.frictionCoefficient * t.mean() - cone.strength;
		};
		const Vec3 compressed(-20e3, -20e3, -20e3 * k - s), extended(-20e3, -20e3 * k - s, -20e3 * k - s);
		EXPECT_NEAR(over(Cone::compression(c, 30 * degree, 0), compressed), 0, 1e-9);
		EXPECT_NEAR(over(Cone::extension(c, 30 * degree, 0), extended), 0, 1e-9);
	}

	TEST(DruckerPrager, ReturnEndsOnTheYieldSurface)
	{
		for (const Parameters& p : all)
			for (const Vec3& e : soilStrains(1000)) {
				const auto   r    = p.law().respond(e, { 0.1 });
				const double size = E * e.norm();
				EXPECT_LT(
				        deviator(r.stress).norm() / std::sqrt(2.) + p.cone.frictionCoefficient * r.stress.mean() - p.cone.strength,
				        2e-13 * size);
				EXPECT_LE(r.stress.mean(), p.mostMean() * (1 + 1e-14) + 1e-13 * size);
				expectConsistent(p.law(), Hencky(E, nu), e, r);
				EXPECT_NEAR(r.internals[0], 0.1 + std::sqrt(2. / 3) * deviator(e - r.elasticStrain).norm(), 1e-8 * e.norm() + 1e-15);
			}
	}

	TEST(DruckerPrager, TangentIsTheDerivativeOfStressInAllSectors)
	{
		for (const Parameters& p : all)
			expectTangents(p.law(), Hencky(E, nu), soilStrains(2000));
	}

	TEST(DruckerPrager, RoundOffDoesNotDecideBetweenSectors)
	{
		for (const Parameters& p : all) {
			expectContinuousOverBoundaries(p.law(), E, soilStrains(400));
			for (const Vec3& e : soilStrains(300))
				expectSameResponseNear(p.law(), E, p.law().respond(e, { 0. }).elasticStrain);
		}
		const DruckerPrager law(E, nu, Cone::planeStrain(0, 30 * degree, 0));
		expectSameResponseNear(law, E, { 1e-3, 0, -1e-3 });
		expectSameResponseNear(law, E, { 1e-3, -1e-3, 0 });
	}

	TEST(DruckerPrager, InLanesAsByItself)
	{
		for (const Parameters& p : all)
			expectSameInLanes(p.law(), soilStrains(400), E);
	}

} // namespace
} // namespace gimpm::soil::testDruckerPrager
