// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/materials/MpmFrictionalMat.hpp"

namespace yade {

class MpmMohrCoulombMat : public ExposedIndexed<MpmMohrCoulombMat, MpmFrictionalMat> {
public:
	// NaN: that before softening
	Real residualCohesion      = std::numeric_limits<Real>::quiet_NaN();
	Real residualFrictionAngle = std::numeric_limits<Real>::quiet_NaN();
	Real residualDilationAngle = std::numeric_limits<Real>::quiet_NaN();
	Real softeningStrain       = std::numeric_limits<Real>::quiet_NaN(); // none

	YADE_API_NAME(MpmMohrCoulombMat)
	static const char* doc()
	{
		return "Hencky elasticity with Mohr-Coulomb's plasticity, perfect unless *softeningStrain* is given: exact edges and apex, flow with a dilation angle of its own. *tensileStrength* "
		       "bounds the largest principal stress. *young*, *poisson*, *cohesion* and *frictionAngle* must be given; strength is in Kirchhoff stress.\n\n"
		       "Set first: *cohesion* of 1e-3 density g H for sand, that its surface has a strength; *dilationAngle*, 0 unless the sand is dense. Page: "
		       "plugin/docs/classes/MpmFrictionalMat.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		using M               = MpmMohrCoulombMat;
		const auto angleOrNot = [](Real value) { return std::isnan(value) || isFrictionAngle(value); };
		v("residualCohesion", &M::residualCohesion, 0, "Cohesion [Pa] from 0 to *cohesion* that *softeningStrain* leaves; NaN, the default: all of it.",
		  admitting("a number from 0 to cohesion [Pa], or NaN, the default: all of it", [](Real value) {
			  return std::isnan(value) || (std::isfinite(value) && value >= 0);
		  }));
		v("residualFrictionAngle", &M::residualFrictionAngle, 0,
		  "Angle of friction [rad] from 0 to *frictionAngle* that *softeningStrain* leaves; NaN, the default: all of it.",
		  admitting("an angle [rad] from 0 to frictionAngle, or NaN, the default: all of it", angleOrNot));
		v("residualDilationAngle", &M::residualDilationAngle, 0,
		  "Angle of dilation [rad] from 0 to *dilationAngle* that *softeningStrain* leaves; NaN, the default: all of it.",
		  admitting("an angle [rad] from 0 to dilationAngle, or NaN, the default: all of it", angleOrNot));
		v("softeningStrain", &M::softeningStrain, 0,
		  "Plastic strain [-] > 0 over which cohesion, friction and dilation fall linearly to the residual ones; NaN, the default: they stay. Needs *MpmImplicitEngine.nonlocalLength*, or results depend on cells.",
		  admitting("a finite number > 0, or NaN, the default: no softening", [](Real value) {
			  return std::isnan(value) || (std::isfinite(value) && value > 0);
		  }));
	}
	void requireAdmissible() const override;
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmMohrCoulombMat)
