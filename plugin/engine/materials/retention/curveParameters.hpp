// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Parameters of retention curves that may differ from point to point.
#include "engine/materials/parameters.hpp"

namespace yade {

// Of the curve of the material; none without one, or of a table.
const vector<ParameterOfClass>& parametersOfCurve(const MpmMaterial&);

// Gives a material a copy of its curve, if it has parameters.
void renewCurve(MpmMaterial&);

bool hasOwnCurve(const MpmMaterial&, const OwnParameters&);

} // namespace yade
