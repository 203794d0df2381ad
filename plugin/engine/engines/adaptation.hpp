// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Cells that are halved by themselves: MpmGrid.adaptation.
#include "engine/analysis/analysis.hpp"
#include "engine/points/MaterialPoints.hpp"

namespace yade {

// Puts the boxes of the coming step into MpmGrid.adapted: cells are halved where the conditions ask for it, at the
// begin or at the end of the step, as often as maxUnknowns admits. Returns a sentence for the log where it admits
// less, empty if there is nothing to say.
string adapt(const Analysis&, const Scene&, const vector<MaterialPoint>&);

} // namespace yade
