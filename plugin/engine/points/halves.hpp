// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Two material points in place of one.
#include "engine/points/MaterialPoints.hpp"

namespace yade {

// Cuts a point in two along an axis of the grid. It becomes the lower half; the body that is returned is the upper one, not yet in a scene, with its middle so far [m] from
// that of the whole. Volume, mass and point load are shared, in a ring by volume; all else is as before in both, but for *halfSize*, which depends on the grid, too.
shared_ptr<Body> halve(const Body&, const MaterialPoint&, int axis, const Vector3r& offset, bool isRing);

} // namespace yade
