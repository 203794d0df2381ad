// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Two material points in place of one.
#include "engine/points/MaterialPoints.hpp"

namespace yade {

// From the middle of a point to that of its upper half: half of the edge of its matter that was along an axis of the
// grid at first.
Vector3r toUpperHalf(const MaterialPoint&, int axis);

// Cuts a point in two across that edge. It becomes the lower half; the body that is returned is the upper one, not yet
// in a scene. Volume, mass and point load are shared, in a ring by volume; all else is as before in both, but for
// *halfSize*, which depends on the grid, too.
shared_ptr<Body> halve(const Body&, const MaterialPoint&, int axis, bool isRing);

} // namespace yade
