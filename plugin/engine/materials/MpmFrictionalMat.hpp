// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/materials/power_elastic.hpp"
#include "engine/materials/MpmElasticMat.hpp"
#include "engine/materials/angles.hpp"
#include <functional>

namespace yade {

// Base of the laws with cohesion and friction.
class MpmFrictionalMat : public ExposedIndexed<MpmFrictionalMat, MpmElasticMat> {
public:
	Real cohesion          = std::numeric_limits<Real>::quiet_NaN(); // must be given, as the moduli
	Real frictionAngle     = std::numeric_limits<Real>::quiet_NaN();
	Real dilationAngle     = 0;
	Real tensileStrength   = std::numeric_limits<Real>::infinity();
	Real power             = 0; // linear
	Real referencePressure = 100e3;

	YADE_API_NAME(MpmFrictionalMat)
	static const char* doc()
	{
		return "Base of the materials with cohesion and friction. It has no constitutive law itself and is refused when used.\n\n"
		       "Set first: a *cohesion* of 1e-3 density g H for sand, that its surface has a strength. Page: plugin/docs/classes/MpmFrictionalMat.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("cohesion", &MpmFrictionalMat::cohesion, 0, "Cohesion c [Pa] >= 0 in Kirchhoff stress: of a change of volume J it is c/J in Cauchy stress.",
		  admitting("a finite number >= 0 [Pa]; there is no default", nonNegative));
		v("frictionAngle", &MpmFrictionalMat::frictionAngle, 0, "Angle of friction phi [rad], from 0 to below pi/2: radians(30) of 30 degrees.",
		  admitting("an angle [rad] from 0 to below pi/2, as radians(30); there is no default", isFrictionAngle));
		v("dilationAngle", &MpmFrictionalMat::dilationAngle, 0,
		  "Angle of dilation psi [rad], from 0 to *frictionAngle*. Where it is smaller, flow is not associated and the stiffness not symmetric.",
		  admitting("an angle [rad] from 0 to frictionAngle, as radians(30)", isFrictionAngle));
		v("tensileStrength", &MpmFrictionalMat::tensileStrength, 0, "Cut of tension [Pa] >= 0, of use below the apex c cot(phi); infinite: none.",
		  admitting("a number >= 0 [Pa], finite or infinite", [](Real value) { return value >= 0; }));
		v("power", &MpmFrictionalMat::power, 0,
		  "Power [-] of the pressure with which moduli go, from 0, the default: they stay, to 0.99; 0.5 of sand. *young* and *poisson* are then those under *referencePressure*.",
		  admitting("a number from 0 to 0.99: above that the strain from no stress on has no bound, and its digits are lost", [](Real value) {
			  return value >= 0 && value <= 0.99;
		  }));
		v("referencePressure", &MpmFrictionalMat::referencePressure, 0,
		  "Pressure [Pa] > 0, all around, to which *young* and *poisson* belong; of use with *power*.",
		  admitting("a finite number > 0 [Pa], positive in compression", positive));
	}
	void requireAdmissible() const override;

	// Its law, by the one with Hencky's elasticity of a Young's modulus and a Poisson's ratio.
	gimpm::Law law(Real viscosity, const std::function<gimpm::PowerElastic::Strength(Real, Real)>& make) const;
	// std::invalid_argument with a power, for another attribute that does not go with it, and what to do instead.
	void       requireWithoutPower(const char* other, Real value, const char* instead) const;
	bool       hasHenckyElasticity() const override { return power == 0; }
	Quantities strengths() const override { return frictionAngle == 0 ? Quantities { { "cohesion", cohesion } } : Quantities(); }
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmFrictionalMat)
