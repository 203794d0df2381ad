// SPDX-License-Identifier: GPL-2.0-or-later
// Edge of the soil on a side of a line.
#pragma once
#include "core/grid/point_cloud.hpp"
#include "core/structures/parting_lines.hpp"

namespace gimpm {

/// Has the points near a line sorted by the axis along which it is longer, so that a position on it need not go through
/// all. Refers to the cloud.
class EdgeOfSoil {
public:
	EdgeOfSoil(const std::vector<Vec<2>>& line, double cellSize, const PointCloud<2>&);

	/// Distance along n from a position on the line at which the points of a side begin that fill the cell beyond,
	/// within half a cell: what lies before its centre reaches as far as it would if it were as wide as what lies
	/// behind. Points are on the side that their centres are on, so that a beam may go through the domains of some.
	double from(const Vec<2>& position, const Vec<2>& n, const BesideLine&) const;

private:
	/// Points of a side, within the reach of a position along each axis, in ascending order.
	std::vector<int> around(const Vec<2>& position, const BesideLine&) const;

	const PointCloud<2>& cloud_;
	double               cellSize_, reach_;
	int                  axis_ = 0;
	std::vector<int>     points_;
};

} // namespace gimpm
