// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/exposed.hpp"

namespace yade {

class MpmAdaptation : public Exposed<MpmAdaptation, Serializable> {
public:
	int    halvings    = 1;
	string where       = "contact";
	Real   maxUnknowns = std::numeric_limits<Real>::infinity();
	bool   merge       = true;

	YADE_API_NAME(MpmAdaptation)
	static const char* doc()
	{
		return "Cells of an MpmGrid that are halved by themselves, anew in each step, where a cell costs most accuracy: around edges, tips and round surfaces of "
		       "rigid bodies, or where the deformation varies most. Cells around them are halved as often as it takes for neighbours to differ by one halving at most.\n\n"
		       "Set first: *halvings* = 1 and the *cellSize* of a run without; then 2, to see what changes. Page: plugin/docs/classes/MpmAdaptation.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("halvings", &MpmAdaptation::halvings, 0, "Number of times that cells of *MpmGrid.cellSize* are halved, 1 to 5, with dim=3 to 3.",
		  oneOf(1, 2, 3, 4, 5));
		v("where", &MpmAdaptation::where, 0,
		  "'contact': around edges, tips and round surfaces of the bodies of each MpmContact; 'error': cells with the largest estimated errors of the deformation gradient, until 5 % are left.",
		  oneOf("contact", "error"));
		v("maxUnknowns", &MpmAdaptation::maxUnknowns, 0,
		  "Displacement unknowns [-] > 0 that a step may have, as estimated from the cells: beyond them cells are halved less often, with a warning; inf, the default: no limit.",
		  admitting("a number > 0, or inf", [](Real most) { return most > 0; }));
		v("merge", &MpmAdaptation::merge, 0,
		  "True, the default: halves of points become one again where cells are no longer halved and the halves are alike. False: they stay.");
	}
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmAdaptation)
