// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/materials/MpmElasticMat.hpp"

namespace yade {

class MpmVonMisesMat : public ExposedIndexed<MpmVonMisesMat, MpmElasticMat> {
public:
	Real yieldStress = std::numeric_limits<Real>::quiet_NaN(); // must be given, as the moduli

	YADE_API_NAME(MpmVonMisesMat)
	static const char* doc()
	{
		return "Hencky elasticity with associated, perfectly plastic von Mises yield (Coombs 2023, eqs. 8 and 9). *young*, *poisson* and *yieldStress* "
		       "must be given.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("yieldStress", &MpmVonMisesMat::yieldStress, 0,
		  "Yield strength rho_y [Pa] > 0 of eq. 8, the limit of sqrt(2 J2) of the Kirchhoff stress: uniaxial yield stress / sqrt(1.5), sqrt(2) times the "
		  "undrained shear strength.",
		  admitting("a finite number > 0 [Pa]; there is no default", positive));
	}
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmVonMisesMat)
