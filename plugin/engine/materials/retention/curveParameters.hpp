// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Parameters of retention curves that may differ from point to point.
#include "engine/materials/parameters.hpp"

namespace yade {

// Parameters of the curve of the material; none without one, or of a table.
const vector<ParameterOfClass>& parametersOfCurve(const MpmMaterial&);

// Gives a material a copy of its curve, if it has parameters.
void renewCurve(MpmMaterial&);

// True if some of these are parameters of its curve.
bool hasOwnCurve(const MpmMaterial&, const OwnParameters&);

} // namespace yade
