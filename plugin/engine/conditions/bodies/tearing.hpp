// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Bodies of points that fall into parts.
#include "engine/analysis/analysis.hpp"
#include "engine/points/MaterialPoints.hpp"

namespace yade {

// Gives parts of a body, and of parts that have come off it before, that no chain of neighbouring cells connects any
// more bodies of their own in MpmGrid.bodies, with surfaces. Returns a doubt, a sentence; empty if there is none.
string tear(const string& body, const Analysis&, const vector<MaterialPoint>&);

} // namespace yade
