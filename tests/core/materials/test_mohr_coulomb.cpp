// SPDX-License-Identifier: GPL-2.0-or-later
// Mohr-Coulomb's law and Tresca's.
#include "scenes.hpp"
#include "soil.hpp"

namespace gimpm::soil::testMohrCoulomb {
namespace {

	constexpr double E = 20e6, nu = 0.3, c = 5e3;

	struct Parameters {
		double cohesion, friction, dilation, tension;

		MohrCoulomb law() const { return { E, nu, cohesion, friction * degree, dilation * degree, tension }; }
		double      k() const { return (1 + std::sin(friction * degree)) / (1 - std::sin(friction * degree)); }
		double      m() const { return (1 + std::sin(dilation * degree)) / (1 - std::sin(dilation * degree)); }
		double      strength() const { return 2 * cohesion * std::sqrt(k()); }
		double      apex() const { return friction > 0 ? strength() / (k() - 1) : infinity; }
	};
	const Parameters all[] = { { c, 30, 30, infinity }, { c, 30, 10, infinity }, { c, 30, 0, infinity }, { c, 0, 0, infinity }, { c, 0, 0, 3e3 },
		                   { 0, 30, 0, infinity },  { 0, 45, 45, infinity }, { c, 30, 10, 1e3 },     { c, 20, 20, 0 },      { c, 45, 0, 4e3 } };

	TEST(MohrCoulomb, StressByNumbers)
	{
		const MohrCoulomb law = Parameters { c, 30, 10, infinity }.law();
		expectStress(law, { 2, -1, -4 }, { -23670.349, -53600.571, -88331.556 });
		expectStress(law, { 1, 0.95, -3 }, { -10638.938, -10638.938, -49237.323 });
		expectStress(law, { 2, -2, -2.02 }, { -11625.949, -52198.354, -52198.354 });
		expectStress(law, { 2, 1.9, 1.8 }, Vec3::Constant(c * std::sqrt(3.)));
		expectStress(law, { -4, 2, -1 }, { -88331.556, -23670.349, -53600.571 });
	}

	TEST(MohrCoulomb, IsSymmetricWithAssociatedFlow)
	{
		for (const Parameters& p : all)
			EXPECT_EQ(p.law().isSymmetric(), p.friction == p.dilation);
		EXPECT_TRUE(MohrCoulomb::tresca(E, nu, c).isSymmetric());
	}

	// Biaxial strength k s3 - 2 c sqrt(k) of a point that flows far with s3 kept: -184,641 Pa at any dilation.
	TEST(MohrCoulomb, BiaxialStrength)
	{
		for (const double dilation : { 30., 10., 0. }) {
			const MohrCoulomb law(50e6, nu, 10e3, 30 * degree, dilation * degree);
			const Vec3        stress = biaxialStrength(law, Hencky(50e6, nu), -50e3);
			EXPECT_NEAR(stress[0], -50e3, 1e-3);
			EXPECT_NEAR(stress[1], -184641.016, 1e-2);
		}
	}

	// tau / sigma_n = sin phi cos psi / (1 - sin phi sin psi) in simple shear at constant normal stress (Davis
	// 1968), not tan phi.
	TEST(MohrCoulomb, SimpleShearStrength)
	{
		for (const auto& [dilation, ratio] : { std::pair { 30., 0.57735 }, std::pair { 15., 0.55475 }, std::pair { 0., 0.5 } }) {
			const MohrCoulomb law(50e6, nu, 0, 30 * degree, dilation * degree);
			EXPECT_NEAR(simpleShearStrength(law, Hencky(50e6, nu), -100e3), ratio, 2e-5);
		}
	}

	/// Planes of the yield surface for sorted stresses, and the sets that can be active together (Koiter): the
	/// first set with positive multipliers and an admissible stress.
	struct Koiter {
		struct Plane {
			Vec3   normal, flow;
			double limit;
		};
		std::vector<Plane>            planes;
		std::vector<std::vector<int>> sets;
		Mat3                          De;
		std::optional<Vec3>           stress;
		Koiter(const Parameters& p, const Vec3& sorted)
		{
			const double k = p.k(), m = p.m(), s = p.strength();
			planes = { { { k, 0, -1 }, { m, 0, -1 }, s }, { { 0, k, -1 }, { 0, m, -1 }, s }, { { k, -1, 0 }, { m, -1, 0 }, s } };
			sets   = { { 0 }, { 0, 1 }, { 0, 2 } };
			if (p.tension < p.apex()) {
				for (int i = 0; i < 3; ++i)
					planes.push_back({ Vec3::Unit(i), Vec3::Unit(i), p.tension });
				for (const auto& set : { std::vector { 3 }, { 0, 3 }, { 3, 4 }, { 0, 1, 3 }, { 0, 2, 3 }, { 0, 3, 4 }, { 3, 4, 5 } })
					sets.push_back(set);
			}
			De               = Hencky(E, nu).respond(sorted, {}).tangent;
			const Vec3 trial = De * sorted;
			if (std::all_of(planes.begin(), planes.end(), [&](const Plane& plane) { return plane.normal.dot(trial) <= plane.limit; }))
				stress = trial;
			for (const auto& set : sets)
				if (!stress) tryWith(set, trial, 1e-9 * trial.norm() + 1e-9);
			if (!stress) stress = Vec3::Constant(p.apex());
		}
		void tryWith(const std::vector<int>& set, const Vec3& trial, double tolerance)
		{
			const int       n = int(set.size());
			Eigen::MatrixXd F(n, 3), G(3, n);
			Eigen::VectorXd over(n);
			for (int i = 0; i < n; ++i) {
				const Plane& p = planes[set[i]];
				F.row(i) = p.normal.transpose(), G.col(i) = p.flow, over[i] = p.normal.dot(trial) - p.limit;
			}
			const Eigen::FullPivLU<Eigen::MatrixXd> lu(F * De * G);
			if (!lu.isInvertible()) return;
			const Eigen::VectorXd multiplier = lu.solve(over);
			const Vec3            t          = trial - De * G * multiplier;
			if ((multiplier.array() < -1e-12).any() || t[0] < t[1] - tolerance || t[1] < t[2] - tolerance) return;
			for (const Plane& p : planes)
				if (p.normal.dot(t) - p.limit > 10 * tolerance) return;
			stress = t;
		}
	};

	TEST(MohrCoulomb, IsTheReturnToTheActivePlanes)
	{
		for (const Parameters& p : all)
			for (const Vec3& e : soilStrains(3000)) {
				const Vec3 sorted = descending(e);
				const Vec3 stress = p.law().respond(sorted, { 0. }).stress;
				EXPECT_LT((stress - *Koiter(p, sorted).stress).norm(), 1e-7 * E * e.norm())
				        << p.friction << " " << p.tension << " " << sorted.transpose();
			}
	}

	TEST(MohrCoulomb, ReturnEndsOnTheYieldSurfaceInTheOrderOfTheStrains)
	{
		for (const Parameters& p : all)
			for (const Vec3& e : soilStrains(1000)) {
				const auto   r    = p.law().respond(e, { 0.1 });
				const double size = E * e.norm();
				const Vec3   t    = descending(r.stress);
				EXPECT_LT(p.k() * t[0] - t[2] - p.strength(), 1e-13 * size * p.k());
				EXPECT_LE(t[0], std::min(p.tension, p.apex()) * (1 + 1e-14) + 1e-13 * size);
				for (int i = 0; i < 3; ++i)
					EXPECT_GE((e[i] - e[(i + 1) % 3]) * (r.stress[i] - r.stress[(i + 1) % 3]), -1e-14 * size * e.norm());
				expectConsistent(p.law(), Hencky(E, nu), e, r);
				EXPECT_NEAR(r.internals[0], 0.1 + std::sqrt(2. / 3) * deviator(e - r.elasticStrain).norm(), 1e-8 * e.norm() + 1e-15);
			}
	}

	TEST(MohrCoulomb, TangentIsTheDerivativeOfStressInAllSectors)
	{
		for (const Parameters& p : all)
			expectTangents(p.law(), Hencky(E, nu), soilStrains(2000));
	}

	TEST(MohrCoulomb, RoundOffDoesNotDecideBetweenSectors)
	{
		for (const Parameters& p : all)
			expectContinuousOverBoundaries(p.law(), E, soilStrains(400));
	}

	// Pure shear without cohesion and dilation ends at the apex, where all sectors meet; returned states begin
	// their next step on a boundary.
	TEST(MohrCoulomb, RoundOffDoesNotDecideAtTheApexOrOnAnEdge)
	{
		const MohrCoulomb law = Parameters { 0, 30, 0, infinity }.law();
		expectSameResponseNear(law, E, { 1e-3, 0, -1e-3 });
		expectSameResponseNear(law, E, { 1e-3, -1e-3, 0 });
		for (const Parameters& p : all)
			for (const Vec3& e : soilStrains(300))
				expectSameResponseNear(p.law(), E, p.law().respond(e, { 0. }).elasticStrain);
	}

	TEST(MohrCoulomb, InLanesAsByItself)
	{
		for (const Parameters& p : all)
			expectSameInLanes(p.law(), soilStrains(400), E);
	}

	TEST(Tresca, BoundsHalfOfTheLargestDifferenceOfStresses)
	{
		const MohrCoulomb law = MohrCoulomb::tresca(E, nu, c);
		for (const Vec3& e : soilStrains(500)) {
			const Vec3 t = descending(law.respond(e, { 0. }).stress);
			EXPECT_LE(t[0] - t[2], 2 * c * (1 + 1e-13) + 1e-13 * E * e.norm());
			EXPECT_NEAR(t.sum(), E / (1 - 2 * nu) * e.sum(), 1e-13 * E * e.norm()) << "no change of volume";
		}
	}

} // namespace
} // namespace gimpm::soil::testMohrCoulomb
