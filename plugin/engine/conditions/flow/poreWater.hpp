// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// For mpm.geostatic: water in the pores of a material at given pressures.
#include "engine/conditions/flow/MpmFlow.hpp"
#include "engine/materials/MpmMaterial.hpp"

namespace yade {

// (degrees of saturation, pressures on the grains [Pa], relative permeabilities) as bytearrays.
py::tuple poreWaterForPython(const MpmFlow&, const MpmMaterial&, const py::object& pressures);

} // namespace yade
