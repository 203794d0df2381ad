// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/registration.hpp"

namespace yade {

class MpmGrid : public Exposed<MpmGrid, Serializable> {
public:
	Real     cellSize = std::numeric_limits<Real>::quiet_NaN(); // must be given
	Vector3r origin   = Vector3r::Zero();
	int      dim      = 2;
	Vector3r period   = Vector3r::Zero();

	YADE_API_NAME(MpmGrid)
	static const char* doc()
	{
		return "Background grid of square (dim=2) or cubic (dim=3) cells. It is unbounded: there are no extents to declare, and only cells that "
		       "material points touch take memory.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("cellSize", &MpmGrid::cellSize, 0, "Edge length h of a cell [m] > 0, without default.",
		  admitting("a finite number > 0 [m]; there is no default", positive));
		v("origin", &MpmGrid::origin, 0,
		  "Position of a node [m], finite; all others are whole cells away from it. With dim=2, mpm.fill puts the points into its plane z.", finite);
		v("dim", &MpmGrid::dim, 0, "2: plane strain in x-y, per metre of thickness; 3: three-dimensional.", oneOf(2, 3));
		v("period", &MpmGrid::period, 0,
		  "Lengths [m] along x, y, z after which the scene repeats itself, from *origin* on: opposite sides are the same nodes. Whole numbers of cells, at "
		  "least 3; 0, the default: not periodic.",
		  nonNegative);
	}

	// Along each axis, 0: not periodic. std::invalid_argument unless these are whole numbers, of as many cells as basis functions need.
	Vector3i periodInCells() const;
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmGrid)
