// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Boxes that conditions are given by.
#include "core/base/types.hpp"
#include <sstream>
#include <stdexcept>

namespace yade {

// std::invalid_argument names an axis along which the corners of a box are swapped. Infinite ones may be equal.
template <class Vector> void requireCorners(const char* ofClass, const Vector& min, const Vector& max)
{
	for (int axis = 0; axis < 3; ++axis) {
		if (!(min[axis] > max[axis])) continue;
		std::ostringstream text;
		text << ofClass << ".min = " << min[axis] << " is greater than max = " << max[axis] << " along "
		     << "xyz"[axis] << "; are they swapped?";
		throw std::invalid_argument(text.str());
	}
}

} // namespace yade
