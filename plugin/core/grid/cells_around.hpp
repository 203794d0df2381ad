// SPDX-License-Identifier: GPL-2.0-or-later
// The block of 3^Dim cells around a cell.
#pragma once
#include "core/base/types.hpp"

namespace gimpm {

template <int Dim> constexpr int cellsAround = Dim == 2 ? 9 : 27; ///< number of cells, with the one in the middle

/// Offset of a cell of the block from the one in the middle, -1 to 1 along each axis; x goes fastest.
template <int Dim> Index<Dim> offsetAround(int number)
{
	Index<Dim> offset;
	for (int a = 0; a < Dim; ++a, number /= 3)
		offset[a] = number % 3 - 1;
	return offset;
}

} // namespace gimpm
