// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/materials/MpmFrictionalMat.hpp"

namespace yade {

class MpmDruckerPragerMat : public ExposedIndexed<MpmDruckerPragerMat, MpmFrictionalMat> {
public:
	string match     = "plane-strain";
	Real   viscosity = 0;

	YADE_API_NAME(MpmDruckerPragerMat)
	static const char* doc()
	{
		return "Hencky elasticity with Drucker and Prager's perfect plasticity, a smooth cone matched to Mohr-Coulomb's law, with a dilation angle of its "
		       "own. *tensileStrength* bounds the mean stress. *young*, *poisson*, *cohesion* and *frictionAngle* must be given; strength is in Kirchhoff "
		       "stress.\n\n"
		       "Set first: *match* = 'plane-strain' in plane strain; *dilationAngle* 0 for loose sand. Page: plugin/docs/classes/MpmDruckerPragerMat.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("match", &MpmDruckerPragerMat::match, 0,
		  "Stress state in which it is as strong as Mohr-Coulomb's law: 'plane-strain' with any dilation, triaxial 'compression' or 'extension'.",
		  oneOf("plane-strain", "compression", "extension"));
		v("viscosity", &MpmDruckerPragerMat::viscosity, 0,
		  "Plastic viscosity [Pa s] >= 0: in simple shear the stress is the strength and this times the rate of shear (Bingham). Needs seconds, as *relaxationTime*.",
		  nonNegative);
	}
	void        requireAdmissible() const override;
	const char* timeAttribute() const override { return viscosity > 0 ? "viscosity" : MpmFrictionalMat::timeAttribute(); }
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmDruckerPragerMat)
