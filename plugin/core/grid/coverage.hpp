// SPDX-License-Identifier: GPL-2.0-or-later
// Gaps and overlaps of the domains of points.
#pragma once
#include "core/base/types.hpp"
#include <vector>

namespace gimpm {

/// Parts of the cells within the soil, those whose neighbours all have centres of points, that domains cover.
struct Coverage {
	double mean      = 0; ///< mean |part - 1| [-]: 0 where domains tile
	double largest   = 0; ///< largest |part - 1| [-]
	int    cells     = 0; ///< within the soil
	int    populated = 0; ///< cells with centres
};

/// Centres and half lengths in units of the cell, from the grid's origin; half lengths of at most half a cell.
template <int Dim> Coverage coverage(const std::vector<Vec<Dim>>& centres, const std::vector<Vec<Dim>>& halfLengths);

} // namespace gimpm
