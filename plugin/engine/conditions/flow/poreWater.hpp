// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Water in the pores of a material at given pressures, for mpm.geostatic.
#include "core/terms/water/soil_water.hpp"
#include "engine/conditions/flow/MpmFlow.hpp"
#include "engine/materials/MpmMaterial.hpp"

namespace yade {

// Bishop's factor that a flow asks for.
gimpm::Bishop bishopOf(const MpmFlow&);

// (degrees of saturation, pressures on the grains [Pa], relative permeabilities) as bytearrays, of a point with these
// parameters of its own, whose volume is that many times the initial one.
py::tuple poreWaterForPython(const MpmFlow&, const MpmMaterial&, const py::object& pressures, const py::dict& parameters, Real volumeRatio);

} // namespace yade
