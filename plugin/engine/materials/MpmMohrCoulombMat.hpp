// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/materials/MpmFrictionalMat.hpp"

namespace yade {

class MpmMohrCoulombMat : public ExposedIndexed<MpmMohrCoulombMat, MpmFrictionalMat> {
public:
	YADE_API_NAME(MpmMohrCoulombMat)
	static const char* doc()
	{
		return "Hencky elasticity with Mohr-Coulomb's perfect plasticity: exact edges and apex, flow with a dilation angle of its own. *tensileStrength* "
		       "bounds the largest principal stress. *young*, *poisson*, *cohesion* and *frictionAngle* must be given; strength is in Kirchhoff stress.\n\n"
		       "Set first: *cohesion* of 1e-3 density g H for sand, that its surface has a strength; *dilationAngle*, 0 unless the sand is dense. Page: "
		       "plugin/docs/classes/MpmFrictionalMat.md.";
	}
	template <class V> static void attributes(V&&) { }
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmMohrCoulombMat)
