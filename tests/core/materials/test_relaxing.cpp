// SPDX-License-Identifier: GPL-2.0-or-later
// Flow in time: Bingham's in simple shear, Duvaut and Lions' over several laws, and their tangents.
#include "core/materials/hardening_soil_small.hpp"
#include "core/materials/in_space.hpp"
#include "core/materials/law.hpp"
#include "core/materials/norsand.hpp"
#include "core/materials/relaxing.hpp"
#include "core/materials/softening_mohr_coulomb.hpp"
#include "element.hpp"
#include <Eigen/LU>
#include <algorithm>

namespace gimpm::testRelaxing {
namespace {

	constexpr double E = 2.6e6, nu = .3, G = 1e6, degree = M_PI / 180;

	template <class L> Relaxing<InSpace<L>> relaxing(const L& law, double time) { return { InSpace<L>(law, nu), time }; }

	/// Shear strain, which is twice the tensor's component, and along the principal axes.
	Vec3 sheared(double strain) { return Vec3(strain / 2, 0, -strain / 2); }

	TEST(Relaxing, SteadyShearOfBinghamsFluidIsStrengthAndViscosityTimesRate)
	{
		constexpr double strength = 100, viscosity = 40, rate = 2.5, step = 1e-5;
		const VonMises   vonMises(E, nu, std::sqrt(2.) * strength);
		Element          fluid(Relaxing<InSpace<VonMises>>::viscous(InSpace<VonMises>(vonMises, nu), viscosity));
		for (int i = 0; i < 200; ++i)
			fluid.apply(sheared(rate * 20 * step), 20 * step);
		EXPECT_NEAR(fluid.stress(0, 0), strength + viscosity * rate, 1e-9 * strength);
		const DruckerPrager cone(E, nu, DruckerPragerCone::planeStrain(strength, 0, 0));
		Element             mud(Relaxing<InSpace<DruckerPrager>>::viscous(InSpace<DruckerPrager>(cone, nu), viscosity));
		for (int i = 0; i < 200; ++i)
			mud.apply(sheared(rate * 20 * step), 20 * step);
		EXPECT_NEAR(mud.stress(0, 0), strength + viscosity * rate, 1e-6 * strength);
	}

	// Perzyna's return for linear hardening: dg = (rho_tr - rho_y) / (2 G + sqrt(2/3) H + 2 eta / dt), by numbers
	// of another implementation.
	TEST(Relaxing, ViscousVonMisesByNumbers)
	{
		constexpr double G = 8e6, K = 17e6, young = 9 * K * G / (3 * K + G), poisson = (3 * K - 2 * G) / (6 * K + 2 * G), H = 1e6, eta = 5e4, dt = .02;
		const VonMises   law(young, poisson, 15e3, H);
		Element          point(Relaxing<InSpace<VonMises>>::viscous(InSpace<VonMises>(law, poisson), eta));
		const Vec3       strain(2e-3, -1e-3, -4e-3);
		point.state.scalar(0) = 1e-4;
		point.apply(strain, dt);
		const double trial = 2 * G * (strain.array() - strain.mean()).matrix().norm(), excess = trial - 15e3 - 1e-4 * H;
		const double flow = excess / (2 * G + std::sqrt(2. / 3) * H + 2 * eta / dt);
		EXPECT_NEAR(point.difference(), std::sqrt(1.5) * (trial - 2 * G * flow), 1e-9 * trial);
		EXPECT_NEAR(point.state.scalar(0), 1e-4 + std::sqrt(2. / 3) * flow, 1e-15);
	}

	TEST(Relaxing, StressGoesToThatOfTheLawAsAnExponential)
	{
		constexpr double time = 2, step = 1e-3;
		Element          point(relaxing(VonMises(E, nu, 1e3), time));
		point.apply(sheared(4e-3), 0); // at once: elastic
		const double first = point.stress(0, 0), last = 1e3 / std::sqrt(2.);
		EXPECT_NEAR(first, G * 4e-3, 1e-9 * first);
		for (int i = 0; i < 2000; ++i)
			point.apply(Mat3(Mat3::Zero()), step);
		EXPECT_NEAR(point.stress(0, 0), last + (first - last) * std::exp(-1.), 1e-3 * first);
		point.apply(Mat3(Mat3::Zero()), 1e9);
		EXPECT_NEAR(point.stress(0, 0), last, 1e-6 * last);
	}

	/// Part of the errors of the tangent below a limit, on random paths from a state.
	template <class L> double partWithTangent(const L& law, const Vec3& pressures, double limit)
	{
		Random              random(5);
		std::vector<double> errors;
		for (int path = 0; path < 10; ++path) {
			Element<L> point(law);
			if (!pressures.isZero(0)) point.press(pressures);
			for (int i = 0; i < 20; ++i) {
				const double size = std::pow(10, random.in(-4.5, -3));
				const Mat3   m = random.matrix<3, 3>(size), strain = (m + m.transpose()) / 2 - .1 * size * Mat3::Identity();
				const double duration = random.in(.1, 3), h = 1e-3 * size;
				Mandel       differences;
				for (int c = 0; c < 6; ++c) {
					const auto at
					        = [&](double s) { return toMandel(point.ask(strain + fromMandel(s * h * Vec6::Unit(c)), duration).stress); };
					differences.col(c) = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
				}
				errors.push_back((differences - point.ask(strain, duration).tangent).norm() / differences.norm());
				point.apply(strain, duration);
			}
		}
		return partBelow(errors, limit);
	}

	TEST(Relaxing, TangentAgainstDifferencesOverEachLaw)
	{
		const Vec3        p = 100e3 * Vec3(.6, 1, .6), none = Vec3::Zero();
		const MohrCoulomb soil(20e6, nu, 5e3, 30 * degree, 10 * degree);
		EXPECT_GT(partWithTangent(relaxing(VonMises(20e6, nu, 15e3, 1e6), 1), none, 1e-8), .95);
		EXPECT_GT(partWithTangent(relaxing(soil, 1), none, 1e-8), .9);
		EXPECT_GT(partWithTangent(relaxing(DruckerPrager(20e6, nu, DruckerPragerCone::planeStrain(5e3, .5, .1)), 1), none, 1e-8), .9);
		EXPECT_GT(partWithTangent(relaxing(CamClay(5e6, 1.2, .1, .03, 1e5, 1e3), 1), p, 1e-7), .9);
		EXPECT_GT(partWithTangent(Relaxing(NorSand({ 45e6, .0015, 390e3, 1.27, .02, 1.8911, 1e3, .4, .4, 70, 1.75, -3.5 }), 1), p, 1e-7), .9);
		const double rest = 1 - std::sin(35 * degree);
		EXPECT_GT(partWithTangent(Relaxing(HardeningSoil({ 30e6, 30e6, 90e6, .2, .5, .9, rest, 1e5, 0, 35 * degree, .1, infinity }), 1), p, 1e-7), .85);
		EXPECT_GT(partWithTangent(Relaxing(SofteningMohrCoulomb(soil, nu, { 1e3, 20 * degree, 0, .01 }), 1), none, 1e-8), .9);
	}

	TEST(SofteningMohrCoulomb, TangentAgainstDifferences)
	{
		Random              random(7);
		std::vector<double> errors;
		for (int path = 0; path < 20; ++path) {
			const MohrCoulomb             first(20e6, nu, 5e3, 30 * degree, 10 * degree);
			Element<SofteningMohrCoulomb> point(SofteningMohrCoulomb(first, nu, { 1e3, 20 * degree, 0, random.in(.005, .05) }));
			for (int i = 0; i < 20; ++i) {
				const double size = std::pow(10, random.in(-4.5, -2.5));
				const Mat3   m = random.matrix<3, 3>(size), strain = (m + m.transpose()) / 2 - .1 * size * Mat3::Identity();
				errors.push_back(point.tangentError(strain, 1e-3, 1e5));
				point.apply(strain);
			}
		}
		EXPECT_GT(partBelow(errors, 1e-7), .85);
	}

	TEST(SofteningMohrCoulomb, FallsLinearlyToItsResidualStrength)
	{
		const MohrCoulomb          first(20e6, nu, 5e3, 30 * degree, 10 * degree);
		const SofteningMohrCoulomb law(first, nu, { 1e3, 20 * degree, 0, .02 });
		EXPECT_EQ(law.softened(0).parameters(), first.parameters());
		EXPECT_GT(law.softened(-.01).parameters()[1], 5e3);
		const auto half = law.softened(.01).parameters(), all = law.softened(1).parameters();
		EXPECT_DOUBLE_EQ(half[1], 3e3);
		EXPECT_NEAR(std::tan(half[2]), (std::tan(30 * degree) + std::tan(20 * degree)) / 2, 1e-12);
		EXPECT_DOUBLE_EQ(half[3], 5 * degree);
		EXPECT_DOUBLE_EQ(all[1], 1e3);
		EXPECT_NEAR(all[2], 20 * degree, 1e-12);
		EXPECT_EQ(all[3], 0);
		// Compressed along y under a pressure: the strengths of Mohr and Coulomb before and after.
		Element<SofteningMohrCoulomb> point(law);
		point.stress = -50e3 * Mat3::Identity(), point.elasticStrain = law.strainOf(point.stress, point.state);
		double     most = 0, grown = 0;
		const auto strength = [](double c, double phi) { return 2 * (c * std::cos(phi) + 50e3 * std::sin(phi)) / (1 - std::sin(phi)); };
		for (int step = 0; step < 1000; ++step) {
			const double before = point.state.scalar(SofteningMohrCoulomb::plasticStrain);
			point.compress(1e-4, 50e3);
			grown = point.state.scalar(SofteningMohrCoulomb::plasticStrain) - before;
			most  = std::max(most, point.difference());
		}
		EXPECT_NEAR(most, strength(5e3, 30 * degree), .01 * most);
		// The residual strength, and what it grows by in a step: a tenth of what it would have fallen by.
		const auto last = law.softened(.02 - .1 * grown).parameters();
		EXPECT_NEAR(point.difference(), strength(last[1], last[2]), 1e-6 * most);
		EXPECT_NEAR(point.difference(), strength(1e3, 20 * degree), 1e-3 * most);
		EXPECT_EQ(point.state.scalar(SofteningMohrCoulomb::softening), point.state.scalar(SofteningMohrCoulomb::plasticStrain));
	}

} // namespace
} // namespace gimpm::testRelaxing
