// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The table that pairs the material classes with the core's constitutive laws.
#include "core/materials/law.hpp"
#include "engine/MpmMaterial.hpp"

namespace yade {

// std::invalid_argument if the material's values are not admissible or its class has no law.
gimpm::Material coreMaterial(const MpmMaterial&);

} // namespace yade
