// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/exposed.hpp"

namespace yade {

class MpmGhost : public Exposed<MpmGhost, Serializable> {
public:
	// Of the mass where nothing is given: bounds the condition number, and takes next to no energy from waves that
	// three cells can carry (docs/theory.md).
	static constexpr Real usualMassFactor = 1e-3, usualExplicitMassFactor = 0.25;

	Real   factor     = 1e-2;
	string scaling    = "mesh-independent";
	Real   massFactor = std::numeric_limits<Real>::quiet_NaN();

	YADE_API_NAME(MpmGhost)
	static const char* doc()
	{
		return "Ghost stabilisation of the cells at the edge of the body (Coombs 2023, section 3): penalises jumps of the displacement gradient across "
		       "their faces, so that the linear system is well conditioned however little of a cell is filled.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("factor", &MpmGhost::factor, 0,
		  "Strength [-] >= 0: gamma_k of eq. 2 is this times Young's modulus, that of the softer of a face's two cells. 0 switches the stabilisation off.",
		  nonNegative);
		v("scaling", &MpmGhost::scaling, 0,
		  "Factor of the integral over a face. 'mesh-independent': gamma_k h / 3; 'paper': gamma_k h^3 / 3 (eq. 2), which fades on fine grids. Equal at "
		  "h = 1 m.",
		  oneOf("mesh-independent", "paper"));
		v("massFactor", &MpmGhost::massFactor, 0,
		  "Of MpmDynamicEngine, ghost mass [-] >= 0: gamma_M is this times the density, the lower of a face's two cells. NaN, the default: 1e-3, with scheme='explicit' 1/4. 0: none.",
		  admitting("a finite number >= 0, or NaN for the default", [](Real value) { return std::isnan(value) || nonNegative(value); }));
	}
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmGhost)
