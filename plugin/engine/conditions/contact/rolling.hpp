// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Free bodies that roll on soil without inertia.
#include "yade_api/scene.hpp"

namespace yade {

// Doubt about a Sphere that YADE moves, on which soil exerts this force in a static step: it rolls on few cells, and
// has turned by half a radian since it was made. Empty: there is none.
string warningOfRolling(const Body&, const Vector3r& force, Real cellSize);

} // namespace yade
