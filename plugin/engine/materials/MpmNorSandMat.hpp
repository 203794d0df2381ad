// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/materials/MpmMaterial.hpp"

namespace yade {

class MpmNorSandMat : public ExposedIndexed<MpmNorSandMat, MpmMaterial> {
public:
	// NaN until given
	Real shearModulus       = std::numeric_limits<Real>::quiet_NaN();
	Real swellingIndex      = std::numeric_limits<Real>::quiet_NaN();
	Real referencePressure  = std::numeric_limits<Real>::quiet_NaN();
	Real criticalStateRatio = std::numeric_limits<Real>::quiet_NaN();
	Real compressionIndex   = std::numeric_limits<Real>::quiet_NaN();
	Real criticalVolume     = std::numeric_limits<Real>::quiet_NaN();
	Real criticalPressure   = 1e3;
	Real curvature          = 0.3;
	Real flowCurvature      = std::numeric_limits<Real>::quiet_NaN(); // default: that of the yield function
	Real hardening          = std::numeric_limits<Real>::quiet_NaN();
	Real specificVolume     = std::numeric_limits<Real>::quiet_NaN();
	Real dilatancyRatio     = 3.5;

	YADE_API_NAME(MpmNorSandMat)
	static const char* doc()
	{
		return "NorSand (Jefferies 1993; Borja and Andrade 2006): sand whose strength and dilation go with its distance to the critical state, in Kirchhoff stress. "
		       "Elastic as Cam clay; as strong in extension as in compression. Points need a pressure to begin with: mpm.geostatic() or mpm.assign(stress=...).\n\n"
		       "Set first: the critical state line, *criticalStateRatio*, *criticalVolume*, *compressionIndex*, and *specificVolume*, 1 + the void ratio; *hardening* of "
		       "50 to 200. Page: plugin/docs/classes/MpmNorSandMat.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		using M          = MpmNorSandMat;
		const auto given = [](const char* text) { return admitting(text, positive); };
		v("shearModulus", &M::shearModulus, 0, "Shear modulus G [Pa] > 0; no default.", given("a finite number > 0 [Pa]; there is no default"));
		v("swellingIndex", &M::swellingIndex, 0,
		  "Elastic volumetric strain over the change of ln p [-] > 0: the bulk modulus is the pressure over it; no default.",
		  given("a finite number > 0; there is no default"));
		v("referencePressure", &M::referencePressure, 0, "Pressure [Pa] > 0 at zero elastic strain, from where that is counted; no default.",
		  given("a finite number > 0 [Pa], positive in compression; there is no default"));
		v("criticalStateRatio", &M::criticalStateRatio, 0,
		  "Ratio M = Q/P > 0 of critical states [-]: 6 sin(phi) / (3 - sin(phi)) of an angle of friction in triaxial compression; no default.",
		  given("a finite number > 0; there is no default"));
		v("compressionIndex", &M::compressionIndex, 0, "Slope lambda [-] > 0 of critical states in v over ln p; no default.",
		  given("a finite number > 0; there is no default"));
		v("criticalVolume", &M::criticalVolume, 0, "Specific volume v = 1 + e [-] > 1 of critical states at *criticalPressure*; no default.",
		  admitting("a finite number > 1, 1 plus the void ratio; there is no default", [](Real value) { return std::isfinite(value) && value > 1; }));
		v("criticalPressure", &M::criticalPressure, 0, "Pressure [Pa] > 0 to which *criticalVolume* belongs.",
		  given("a finite number > 0 [Pa], positive in compression"));
		v("curvature", &M::curvature, 0, "N [-] of the yield function, from 0, that of Cam clay's first form, to below 1.",
		  admitting("a number from 0 to 1, 1 excluded", [](Real value) { return value >= 0 && value < 1; }));
		v("flowCurvature", &M::flowCurvature, 0,
		  "N [-] of the plastic potential, from 0 to *curvature*; NaN, the default: *curvature*, with which flow is associated.",
		  admitting("a number from 0 to curvature, or NaN, the default: curvature", [](Real value) {
			  return std::isnan(value) || (value >= 0 && value < 1);
		  }));
		v("hardening", &M::hardening, 0, "h [-] > 0, with which the image pressure goes to its limit in plastic shear; no default.",
		  given("a finite number > 0; there is no default"));
		v("specificVolume", &M::specificVolume, 0,
		  "Specific volume v = 1 + e [-] > 1 at first; points have their own by mpm.assign(specificVolume=...); no default.",
		  admitting("a finite number > 1, 1 plus the void ratio; there is no default", [](Real value) { return std::isfinite(value) && value > 1; }));
		v("dilatancyRatio", &M::dilatancyRatio, 0, "Largest dilatancy over the state parameter [-] > 0, without its sign.",
		  given("a finite number > 0; 3.5 is usual"));
	}
	void       requireAdmissible() const override;
	void       requireStart(const Matrix3r& stress) const override;
	Quantities moduli() const override { return { { "shearModulus", shearModulus } }; }
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmNorSandMat)
