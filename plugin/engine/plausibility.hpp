// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Scenes that could be computed but can hardly be meant.
#include "engine/MaterialPoints.hpp"

namespace yade {
class MpmBoundary;
class MpmImplicitEngine;

// To be asked before the first step. std::invalid_argument for what would be left out without a word, or counted twice: gravity across the
// plane of a two-dimensional grid, points in the same place, an O.dt that nobody has set or that jumps over the whole load curve. A warning
// in YADE's log for gravity upwards and for cells that are far too large for the points.
void requirePlausible(const MpmImplicitEngine&, const vector<MaterialPoint>&);

// Of boundaries that do not reach any of the points, a sentence for each; empty if there is none. Some may be left out.
string idleBoundaries(const MpmImplicitEngine&, const vector<MaterialPoint>&, const vector<const MpmBoundary*>& except = {});

} // namespace yade
