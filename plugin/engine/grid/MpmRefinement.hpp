// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/grid/grid.hpp"
#include "engine/grid/box.hpp"
#include "yade_api/exposed.hpp"

namespace yade {

class MpmRefinement : public Exposed<MpmRefinement, Serializable> {
public:
	Vector3r min      = Vector3r::Constant(-std::numeric_limits<Real>::infinity());
	Vector3r max      = Vector3r::Constant(std::numeric_limits<Real>::infinity());
	int      halvings = 1;

	YADE_API_NAME(MpmRefinement)
	static const char* doc()
	{
		return "A box in which the cells of an MpmGrid are halved, once or more. Cells that overlap the box are halved as a whole, and cells around them "
		       "as often as it takes for neighbours to differ by one halving at most. Of several boxes the most halvings count.\n\n"
		       "Set first: a box as wide as what yields, and *halvings* = 2; mpm.refinementsAt makes boxes. Page: plugin/docs/classes/MpmRefinement.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("min", &MpmRefinement::min, 0, "Lower corner of the box [m]; -inf, the default, where it has no limit.", notNaN);
		v("max", &MpmRefinement::max, 0, "Upper corner of the box [m]; inf, the default, where it has no limit.", notNaN);
		v("halvings", &MpmRefinement::halvings, 0, "Number of times that cells are halved, 1 to 5, with dim=3 to 3; once: *MpmGrid.cellSize* / 2.",
		  oneOf(1, 2, 3, 4, 5));
	}

	// Corners that are swapped in the constructor.
	void postLoad() { requireCorners("MpmRefinement", min, max); }

	// The attributes must go together, too.
	void requireAdmissible() const override
	{
		Exposed::requireAdmissible();
		requireCorners("MpmRefinement", min, max);
	}
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmRefinement)
