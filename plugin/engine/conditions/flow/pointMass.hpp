// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Mass of material points with the water that their pores have.
#include "engine/conditions/flow/MpmFlow.hpp"
#include "engine/points/MaterialPoints.hpp"
#include "engine/points/energies.hpp"

namespace yade {

// Mass with the water that pores have, where the flow is one of whole pressures. Gravity tells the density of the
// water from its weight.
PointMass pointMass(const shared_ptr<MpmFlow>&, const Vector3r& gravity);

} // namespace yade
