// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/points/MaterialPoints.hpp"

namespace yade {
class MpmImplicitEngine;

// Water whose numbers are of another unit, a sentence; empty if there is none.
string doubtOfWeight(const MpmImplicitEngine&);

// The same of water with a level that presses on both sides of a body which stands out of it, where nothing holds these.
string doubtOfSides(const MpmImplicitEngine&, const vector<MaterialPoint>&);

} // namespace yade
