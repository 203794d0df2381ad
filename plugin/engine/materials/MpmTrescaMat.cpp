// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmTrescaMat.hpp"
#include "core/materials/law.hpp"
#include "engine/materials/law_of_class.hpp"
#include "engine/materials/over_time.hpp"
#include "yade_api/registration.hpp"

namespace yade {
static const RegisteredLaw<MpmTrescaMat> lawOfMpmTrescaMat(
        [](const MpmTrescaMat& m) { return overTime(m, gimpm::MohrCoulomb::tresca(m.young, m.poisson, m.undrainedStrength), m.poisson); },
        std::pair("young", &MpmElasticMat::young), std::pair("undrainedStrength", &MpmTrescaMat::undrainedStrength));
} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmTrescaMat)
static const yade::PluginClasses<yade::MpmTrescaMat> registeredMpmTrescaMat(__FILE__);
