// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Water in the pores of a material at given pressures, for mpm.geostatic.
#include "core/terms/water/soil_water.hpp"
#include "engine/conditions/flow/MpmFlow.hpp"
#include "engine/materials/MpmMaterial.hpp"

namespace yade {

// Bishop's factor that a flow asks for.
gimpm::Bishop bishopOf(const MpmFlow&);

// (degrees of saturation, pressures on the grains [Pa], relative permeabilities) as bytearrays.
py::tuple poreWaterForPython(const MpmFlow&, const MpmMaterial&, const py::object& pressures);

} // namespace yade
