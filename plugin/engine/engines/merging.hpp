// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Halves of material points that become one again where cells are no longer halved.
#include "engine/analysis/analysis.hpp"
#include "engine/points/MaterialPoints.hpp"

namespace yade {

// Merges halves before a step, of which the cells are known. Those that are alike become one if cells have two points
// along each axis all the same, those within reach of the whole too. The upper bodies are erased from the scene and
// from the list. In one step this takes no more than 1e-4 of the energy that is stored; returns what it takes [J].
Real mergeHalves(const Analysis&, Scene&, vector<MaterialPoint>&);

} // namespace yade
