// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/materials/hardening_soil.hpp"
#include "engine/materials/MpmMaterial.hpp"
#include "engine/materials/angles.hpp"

namespace yade {

class MpmHardeningSoilMat : public ExposedIndexed<MpmHardeningSoilMat, MpmMaterial> {
public:
	// NaN until given
	Real E50ref            = std::numeric_limits<Real>::quiet_NaN();
	Real Eoedref           = std::numeric_limits<Real>::quiet_NaN();
	Real Eurref            = std::numeric_limits<Real>::quiet_NaN();
	Real poisson           = 0.2;
	Real power             = std::numeric_limits<Real>::quiet_NaN();
	Real failureRatio      = 0.9;
	Real K0nc              = std::numeric_limits<Real>::quiet_NaN();
	Real referencePressure = 100e3;
	Real cohesion          = std::numeric_limits<Real>::quiet_NaN();
	Real frictionAngle     = std::numeric_limits<Real>::quiet_NaN();
	Real dilationAngle     = 0;
	Real mostDilation      = std::numeric_limits<Real>::infinity();
	Real G0ref             = std::numeric_limits<Real>::quiet_NaN();
	Real gamma07           = std::numeric_limits<Real>::quiet_NaN();

	YADE_API_NAME(MpmHardeningSoilMat)
	static const char* doc()
	{
		return "Hardening soil (Schanz, Vermeer and Bonnier 1999): moduli that go with a power of the smallest pressure, shear hardening along a hyperbola "
		       "up to Mohr and Coulomb's strength, a cap. With *G0ref* and *gamma07* small strains are stiffer (Benz 2007).\n\n"
		       "Set first: *Eoedref* = *E50ref*, *Eurref* of three times that, *power* 0.5 for sand and 1 for clay, *K0nc* = 1 - sin(frictionAngle); stresses by "
		       "mpm.geostatic(OCR=...). Page: plugin/docs/classes/MpmHardeningSoilMat.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		using M               = MpmHardeningSoilMat;
		const auto modulus    = [](const char* text) { return admitting(text, positive); };
		const auto givenOrNot = [](Real value) { return std::isnan(value) || (std::isfinite(value) && value > 0); };
		v("E50ref", &M::E50ref, 0,
		  "Secant modulus E50 [Pa] > 0 of a drained triaxial test at half of the strength, under *referencePressure*; no default.",
		  modulus("a finite number > 0 [Pa]; there is no default"));
		v("Eoedref", &M::Eoedref, 0,
		  "Tangent modulus Eoed [Pa] > 0 of first loading in an oedometer, at the vertical pressure *referencePressure*; no default.",
		  modulus("a finite number > 0 [Pa]; there is no default"));
		v("Eurref", &M::Eurref, 0,
		  "Young's modulus Eur [Pa] of unloading and reloading under *referencePressure*, > 2 *E50ref* / (2 - *failureRatio*); no default.",
		  modulus("a finite number > 2 E50ref / (2 - failureRatio) [Pa]; there is no default"));
		v("poisson", &M::poisson, 0, "Poisson's ratio [-] of unloading and reloading, from 0 to below 0.5.",
		  admitting("a number from 0 to 0.5, 0.5 excluded", [](Real value) { return value >= 0 && value < 0.5; }));
		v("power", &M::power, 0, "Power m [-] of the smallest pressure, from 0 to 1, with which moduli go; no default.",
		  admitting("a number from 0 to 1; there is no default", [](Real value) { return value >= 0 && value <= 1; }));
		v("failureRatio", &M::failureRatio, 0, "Ratio Rf [-] of the strength to the hyperbola's asymptote, from 0 to below 1.",
		  admitting("a number from 0 to 1, 1 excluded", [](Real value) { return value >= 0 && value < 1; }));
		v("K0nc", &M::K0nc, 0,
		  "Ratio K0 [-] of horizontal to vertical stress in first loading without horizontal strain, below 1; 1 - sin(phi) as a rule; no default.",
		  admitting("a number between 0 and 1, both excluded; there is no default", strictlyBetween(0, 1)));
		v("referencePressure", &M::referencePressure, 0, "Pressure [Pa] > 0 to which the moduli belong.",
		  admitting("a finite number > 0 [Pa], positive in compression", positive));
		v("cohesion", &M::cohesion, 0, "Cohesion c [Pa] >= 0 in Kirchhoff stress; no default.",
		  admitting("a finite number >= 0 [Pa]; there is no default", nonNegative));
		v("frictionAngle", &M::frictionAngle, 0, "Angle of friction phi [rad] at failure, above 0 and below pi/2, as radians(35); no default.",
		  admitting("an angle [rad] above 0 and below pi/2, as radians(35); there is no default", [](Real value) {
			  return value > 0 && isFrictionAngle(value);
		  }));
		v("dilationAngle", &M::dilationAngle, 0,
		  "Angle of dilation psi [rad] at failure, from 0 to *frictionAngle*; before that it follows Rowe's theory.",
		  admitting("an angle [rad] from 0 to frictionAngle, as radians(5)", isFrictionAngle));
		v("mostDilation", &M::mostDilation, 0,
		  "Extension of volume [-] > 0, ln((1 + e_max) / (1 + e)) of void ratios, from which on nothing dilates; infinite: no such cut-off.",
		  admitting("a number > 0, finite or infinite", [](Real value) { return value > 0; }));
		v("G0ref", &M::G0ref, 0,
		  "Shear modulus G0 [Pa] of very small strains under *referencePressure*, at least Eurref / (2 + 2 poisson); NaN: no small-strain stiffness.",
		  admitting("a finite number > 0 [Pa], or NaN, the default: none", givenOrNot));
		v("gamma07", &M::gamma07, 0, "Shear strain [-] > 0 at which the secant shear modulus is 0.722 *G0ref*; some 1e-4.",
		  admitting("a finite number > 0, or NaN, the default: none", givenOrNot));
	}
	void       requireAdmissible() const override;
	Quantities moduli() const override { return { { "E50ref", E50ref }, { "Eoedref", Eoedref }, { "Eurref", Eurref } }; }

	gimpm::HardeningSoil::Given given() const;
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmHardeningSoilMat)
