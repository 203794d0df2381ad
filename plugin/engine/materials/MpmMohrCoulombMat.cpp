// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmMohrCoulombMat.hpp"
#include "core/materials/law.hpp"
#include "engine/materials/law_of_class.hpp"
#include "yade_api/registration.hpp"

namespace yade {
static const RegisteredLaw<MpmMohrCoulombMat> lawOfMpmMohrCoulombMat(
        [](const MpmMohrCoulombMat& m) { return gimpm::MohrCoulomb(m.young, m.poisson, m.cohesion, m.frictionAngle, m.dilationAngle, m.tensileStrength); },
        std::pair("young", &MpmElasticMat::young), std::pair("cohesion", &MpmFrictionalMat::cohesion),
        std::pair("frictionAngle", &MpmFrictionalMat::frictionAngle), std::pair("dilationAngle", &MpmFrictionalMat::dilationAngle),
        std::pair("tensileStrength", &MpmFrictionalMat::tensileStrength));
} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmMohrCoulombMat)
static const yade::PluginClasses<yade::MpmMohrCoulombMat> registeredMpmMohrCoulombMat(__FILE__);
