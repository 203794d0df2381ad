// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The table that pairs the material classes with the core's constitutive laws.
#include "core/materials/law.hpp"
#include "engine/materials/MpmMaterial.hpp"

namespace yade {

// std::invalid_argument if the material's values are not admissible or its class has no law.
gimpm::Material coreMaterial(const MpmMaterial&);

// Between Kirchhoff stress [Pa] and elastic logarithmic strain of a point at rest with this equivalent plastic strain.
// std::invalid_argument if that state lies outside of the law's yield surface.
Matrix3r kirchhoffStressOf(const gimpm::Material&, const Matrix3r& elasticStrain, Real plasticStrain);
Matrix3r elasticStrainOf(const gimpm::Material&, const Matrix3r& kirchhoffStress, Real plasticStrain);

} // namespace yade
