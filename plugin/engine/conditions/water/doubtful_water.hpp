// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/points/MaterialPoints.hpp"

namespace yade {
class Analysis;
class MpmWater;

// Water whose numbers are of another unit, a sentence; empty if there is none.
string warningOfWeight(const MpmWater&, const Analysis&, const string& name);

// The same of water with a level that presses on both sides of a body which stands out of it, where nothing constrains
// these.
string warningOfSides(const MpmWater&, const Analysis&, const vector<MaterialPoint>&, const string& name);

// Sentence on water of a loaded scene, whose function is not saved; empty if it has its function.
string warningOfLostFunction(const MpmWater&, const string& name);

} // namespace yade
