// SPDX-License-Identifier: GPL-2.0-or-later
// Positions seen from a line of straight pieces in the plane.
#pragma once
#include "core/base/types.hpp"
#include <limits>
#include <vector>

namespace gimpm {

/// Closest-point projection of a position on a line, and the side of the line that it is on. Of several pieces that are
/// as near the first one counts, except for the side.
struct FromLine {
	double away = std::numeric_limits<double>::infinity(); ///< distance [m]
	Vec<2> foot = Vec<2>::Zero(), normal = Vec<2>::Zero(); ///< on the nearest piece, and to the left of it
	double left     = 0;                                   ///< distance to the left of the straight line through the nearest piece [m]
	double side     = 0;     ///< > 0 left, < 0 right; of two pieces that meet in the nearest corner, the sum of their distances [m]
	bool   isBeyond = false; ///< one of the ends of a line that is not closed
};

/// A line is closed if its last position is its first one.
FromLine fromLine(const std::vector<Vec<2>>& line, const Vec<2>& position);

} // namespace gimpm
