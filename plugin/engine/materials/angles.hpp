// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/types.hpp"
#include <cmath>

namespace yade {

// Range of angles of friction [rad]: one in degrees is hardly ever below pi/2.
inline bool isFrictionAngle(Real angle) { return angle >= 0 && angle < M_PI / 2; }

} // namespace yade
