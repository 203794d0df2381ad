// SPDX-License-Identifier: GPL-2.0-or-later
// State after a law, which the next step must admit in spite of round-off: internal variables are admitted, and elastic
// answers leave the state as it was before.
#include "soil.hpp"

namespace gimpm::soil::testAdmittedStates {
namespace {

	/// A principal stress whose return begins on a yield surface, times a number around one: next to it, and by
	/// round-off on either side.
	double around(Random& random)
	{
		return 1 + (random.in(0, 1) < .5 ? 1e-15 * std::round(random.in(-8, 8)) : std::pow(10, random.in(-14, -1)) * random.in(-.2, 1));
	}

	template <class L> void expectAdmitted(const L& law, const Vec3& e, const decltype(law.initialInternals())& before, bool isInside)
	{
		const auto r = law.respond(e, before);
		if (r.failed) return;
		for (std::size_t k = 0; k < before.size(); ++k) {
			const InternalVariable& variable = law.variables[k];
			EXPECT_TRUE(variable.admits(r.internals[k])) << variable.name << " = " << r.internals[k] << " of strains " << e.transpose();
			if (std::string(variable.name) == equivalentPlasticStrain.name) {
				EXPECT_GE(r.internals[k], before[k]) << "of strains " << e.transpose();
			}
		}
		if (isInside) {
			EXPECT_EQ(r.internals, before) << "of strains " << e.transpose();
		}
	}

	/// Strains that are multiples of one that yields, around the multiple at which it begins to; where that is
	/// sharp, less than that leaves all as it was.
	template <class L> void expectAdmittedAroundYield(const L& law, const std::vector<Vec3>& directions, bool isSharp = true)
	{
		Random random(11);
		for (const Vec3& e : directions) {
			double low = 0, high = 1;
			for (int i = 0; i < 60; ++i) {
				const double middle                                             = (low + high) / 2;
				const auto   r                                                  = respondTo(law, Vec3(middle * e));
				(!r.failed && r.elasticStrain == Vec3(middle * e) ? low : high) = middle;
			}
			for (int i = 0; i < 8; ++i) {
				const double factor = around(random);
				expectAdmitted(law, Vec3(high * factor * e), law.initialInternals(), isSharp && factor < 1 - 1e-6);
			}
		}
	}

	std::vector<Vec3> directions(int count, double mean)
	{
		std::vector<Vec3> all = soilStrains(count);
		// Nearly isotropic, as ground that has been consolidated only.
		for (std::size_t i = 0; i < all.size(); i += 2) {
			all[i] = Vec3::Constant(mean) + 1e-9 * all[i];
			if (i % 4 == 0) all[i][2] = all[i][1];
		}
		return all;
	}

	TEST(AdmittedStates, AreWhatCamClayLeaves)
	{
		for (const double ratio : { .6, 1., 1.328 }) {
			const CamClay clay(1e6, ratio, .18, .07, 1e5, 1e4);
			expectAdmittedAroundYield(clay, directions(2000, -.1));
		}
	}

	// A point whose return passes through rounding: its plastic strain was -7e-19.
	TEST(AdmittedStates, AreWhatCamClayLeavesOfOneThatHardlyFlows)
	{
		const CamClay clay(1039013.923773673, 1.133665873220736, 0.17909309073005497, 0.06968442121421436, 1e5, 1e4);
		const Vec3    e(-0.05189086384253094, -0.054218142364232294, -0.054218142364232294);
		expectAdmitted(clay, e, clay.initialInternals(), false);
	}

	// The plastic part of a hardening that is far stiffer than the soil is round-off.
	TEST(AdmittedStates, AreWhatVonMisesLeaves)
	{
		for (const double hardening : { 0., -1e5, 1e6, 1e14, 1e17, 1e22 })
			expectAdmittedAroundYield(VonMises(1e6, .3, 1e3, hardening), soilStrains(2000), hardening < 1e10);
	}

	TEST(AdmittedStates, AreWhatFrictionLeaves)
	{
		expectAdmittedAroundYield(MohrCoulomb(1e6, .3, 1e2, 30 * degree, 10 * degree), soilStrains(2000));
		expectAdmittedAroundYield(MohrCoulomb(1e6, .3, 1e2, 30 * degree, 0, 50), soilStrains(2000));
		expectAdmittedAroundYield(MohrCoulomb::tresca(1e6, .4999, 1e2), soilStrains(2000));
		expectAdmittedAroundYield(DruckerPrager(1e6, .3, DruckerPragerCone::planeStrain(1e2, 30 * degree, 10 * degree), 50), soilStrains(2000));
	}

} // namespace
} // namespace gimpm::soil::testAdmittedStates
