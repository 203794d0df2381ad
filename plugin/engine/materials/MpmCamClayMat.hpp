// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/materials/MpmMaterial.hpp"

namespace yade {

class MpmCamClayMat : public ExposedIndexed<MpmCamClayMat, MpmMaterial> {
public:
	// NaN until given
	Real shearModulus       = std::numeric_limits<Real>::quiet_NaN();
	Real criticalStateRatio = std::numeric_limits<Real>::quiet_NaN();
	Real compressionIndex   = std::numeric_limits<Real>::quiet_NaN();
	Real swellingIndex      = std::numeric_limits<Real>::quiet_NaN();
	Real preconsolidation   = std::numeric_limits<Real>::quiet_NaN();
	Real referencePressure  = std::numeric_limits<Real>::quiet_NaN();

	YADE_API_NAME(MpmCamClayMat)
	static const char* doc()
	{
		return "Modified Cam clay in Kirchhoff stress: bulk modulus proportional to the pressure, shear modulus constant, associated flow, critical state. "
		       "A point's preconsolidation pressure is a column of mpm.arrays and mpm.assign. Points need a pressure to begin with: mpm.geostatic() or "
		       "mpm.assign(stress=...).\n\n"
		       "Set first: *compressionIndex* of some 0.1 and *swellingIndex* of a fifth to a tenth of it, slopes of ln v over ln p; "
		       "mpm.geostatic(OCR=...) gives each point its preconsolidation. Page: plugin/docs/classes/MpmCamClayMat.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		const auto given = [](const char* text) { return admitting(text, positive); };
		v("shearModulus", &MpmCamClayMat::shearModulus, 0, "Shear modulus G [Pa] > 0, without default.",
		  given("a finite number > 0 [Pa]; there is no default"));
		v("criticalStateRatio", &MpmCamClayMat::criticalStateRatio, 0,
		  "Ratio M = Q/P > 0 of critical states [-], without default: 6 sin(phi) / (3 - sin(phi)) of an angle of friction in triaxial compression.",
		  given("a finite number > 0; there is no default"));
		v("compressionIndex", &MpmCamClayMat::compressionIndex, 0,
		  "Slope lambda [-] > *swellingIndex* of compression in ln v over ln p, without default; a slope in v over ln p divided by v.",
		  given("a finite number > swellingIndex; there is no default"));
		v("swellingIndex", &MpmCamClayMat::swellingIndex, 0, "Slope kappa [-] > 0 of swelling in ln v over ln p, without default.",
		  given("a finite number > 0 and < compressionIndex; there is no default"));
		v("preconsolidation", &MpmCamClayMat::preconsolidation, 0, "Preconsolidation pressure pc [Pa] > 0 at first, without default.",
		  given("a finite number > 0 [Pa], positive in compression; there is no default"));
		v("referencePressure", &MpmCamClayMat::referencePressure, 0, "Pressure [Pa] > 0 at zero elastic strain, without default.",
		  given("a finite number > 0 [Pa], positive in compression; there is no default"));
	}
	void       requireAdmissible() const override;
	void       requireStart(const Matrix3r& stress) const override;
	Quantities moduli() const override { return { { "shearModulus", shearModulus } }; }
	Quantities strengths() const override { return { { "preconsolidation", preconsolidation } }; }
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmCamClayMat)
