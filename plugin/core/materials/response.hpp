// SPDX-License-Identifier: GPL-2.0-or-later
// What a constitutive law answers, in the principal axes of the trial elastic strain.
#pragma once
#include "core/types.hpp"

namespace gimpm {

/// Isotropic law: stress and trial strain share their principal axes, so that a law needs principal values only.
struct Response {
	Vec3   stress;        ///< principal Kirchhoff stresses [Pa]
	Mat3   tangent;       ///< consistent tangent d stress_i / d trialStrain_j [Pa]
	Vec3   shear;         ///< G_s of the axis pairs (0,1), (1,2), (2,0): stress_i - stress_j = 2 G_s (trialStrain_i - trialStrain_j)
	Vec3   elasticStrain; ///< principal elastic logarithmic strains after the return
	double plasticStrain; ///< equivalent plastic strain after the return
};

} // namespace gimpm
