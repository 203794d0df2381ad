// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Numbers of materials that hardly any ground has, but which fit another unit.
#include "core/materials/material.hpp"
#include "engine/points/MaterialPoints.hpp"

namespace yade {

// A sentence about the first of them; empty if there is none. `index`: of each point the number of its material;
// `height`: of the body along gravity [m]. Under a gravity of 1 m/s2 or less they are hardly those of ground on earth.
string warningOfUnits(const Vector3r& gravity, Real height, const vector<MaterialPoint>&, const vector<int>& index, const vector<gimpm::Material>&);

} // namespace yade
