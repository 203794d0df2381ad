// SPDX-License-Identifier: GPL-2.0-or-later
// Strength reduction, of which each law says what it makes of its parameters.
#pragma once
#include <algorithm>
#include <cmath>

namespace gimpm {

struct Weakening {
	double strength = 1; ///< factor of safety: c and tan(phi) are divided by it
	double moduli   = 1; ///< all moduli are multiplied by it

	double reducedAngle(double friction) const { return strength == 1 ? friction : std::atan(std::tan(friction) / strength); }
};

} // namespace gimpm
