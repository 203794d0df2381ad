// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/exposed.hpp"

namespace yade {

class MpmGhost : public Exposed<MpmGhost, Serializable> {
public:
	// Default factors of the ghost mass: bound the condition number, and take next to no energy from waves that
	// three cells can carry (docs/explanation/time-integration.md).
	static constexpr Real usualMassFactor = 1e-3, usualExplicitMassFactor = 0.25;

	Real   factor        = 1e-2;
	string scaling       = "mesh-independent";
	string where         = "boundary";
	Real   threshold     = 0.25;
	Real   memory        = 0;
	Real   massFactor    = std::numeric_limits<Real>::quiet_NaN();
	Real   workTolerance = 1;

	YADE_API_NAME(MpmGhost)
	static const char* doc()
	{
		return "Ghost stabilisation of the cells at the edge of the body (Coombs 2023, section 3): penalises jumps of the displacement gradient across "
		       "their faces, so that the linear system is well conditioned however little of a cell is filled.\n\n"
		       "Leave it as it is: *factor* = 0.01 suits cells of any size; with 0, plain GIMPM, runs fail at any step. Page: "
		       "plugin/docs/classes/MpmGhost.md.";
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
		v("where", &MpmGhost::where, 0,
		  "'boundary', the default: alike on all faces of boundary cells; 'aggregates', for sand: on those that tie ill-filled cells to well-filled ones, a hundredth elsewhere.",
		  oneOf("boundary", "aggregates"));
		v("threshold", &MpmGhost::threshold, 0, "Limit with where='aggregates': part of a cell [-], from above 0 to 1, below which it is ill-filled.",
		  admitting("a number from above 0 to 1", [](Real part) { return part > 0 && part <= 1; }));
		v("memory", &MpmGhost::memory, 0,
		  "Part [-] of the last step's displacements, in the ratio of the loads, whose gradient may jump freely: 0, the default, to 1. For sand: steady flow is not resisted.",
		  admitting("a number from 0 to 1", [](Real part) { return part >= 0 && part <= 1; }));
		v("massFactor", &MpmGhost::massFactor, 0,
		  "Ghost mass of MpmDynamicEngine [-] >= 0: gamma_M is this times the density, the lower of a face's two cells. NaN, the default: 1e-3, with scheme='explicit' 1/4. 0: none.",
		  admitting("a finite number >= 0, or NaN for the default", [](Real value) { return std::isnan(value) || nonNegative(value); }));
		v("workTolerance", &MpmGhost::workTolerance, 0,
		  "Largest part of the work [-] of static steps that it may take up (*ghostShare*): beyond, the step goes on until stress bears the load, or fails. 1: no limit.",
		  admitting("a number from above 0 to 1", [](Real part) { return part > 0 && part <= 1; }));
	}
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmGhost)
