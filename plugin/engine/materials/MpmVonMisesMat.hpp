// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/materials/MpmElasticMat.hpp"

namespace yade {

class MpmVonMisesMat : public ExposedIndexed<MpmVonMisesMat, MpmElasticMat> {
public:
	Real yieldStress         = std::numeric_limits<Real>::quiet_NaN(); // must be given, as the moduli
	Real hardening           = 0;
	Real residualYieldStress = 0;
	Real viscosity           = 0;

	YADE_API_NAME(MpmVonMisesMat)
	static const char* doc()
	{
		return "Hencky elasticity with associated von Mises yield (Coombs 2023, eqs. 8 and 9), perfectly plastic unless *hardening* is given. *young*, "
		       "*poisson* and *yieldStress* must be given.\n\n"
		       "Set first: *yieldStress* = sqrt(2) c_u for clay of undrained strength c_u, and MpmImplicitEngine(fBar=True). Page: "
		       "plugin/docs/classes/MpmVonMisesMat.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("yieldStress", &MpmVonMisesMat::yieldStress, 0,
		  "Yield strength rho_y [Pa] > 0 of eq. 8, the limit of sqrt(2 J2) of the Kirchhoff stress: uniaxial yield stress / sqrt(1.5), sqrt(2) times the "
		  "undrained shear strength.",
		  admitting("a finite number > 0 [Pa]; there is no default", positive));
		v("hardening", &MpmVonMisesMat::hardening, 0,
		  "Growth of rho_y per equivalent plastic strain [Pa] > -sqrt(6) G. Where negative the soil softens, and results depend on *cellSize*.",
		  finite);
		v("residualYieldStress", &MpmVonMisesMat::residualYieldStress, 0, "Below this [Pa], from 0 to *yieldStress*, softening does not bring rho_y.",
		  nonNegative);
		v("viscosity", &MpmVonMisesMat::viscosity, 0,
		  "Plastic viscosity [Pa s] >= 0: in simple shear the stress is the strength and this times the rate of shear (Bingham). Needs seconds, as *relaxationTime*.",
		  nonNegative);
	}
	void        requireAdmissible() const override;
	const char* timeAttribute() const override { return viscosity > 0 ? "viscosity" : MpmElasticMat::timeAttribute(); }
	Quantities  strengths() const override { return { { "yieldStress", yieldStress } }; }
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmVonMisesMat)
