// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmMohrCoulombMat.hpp"
#include "yade_api/registration.hpp"

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmMohrCoulombMat)
static const yade::PluginClasses<yade::MpmMohrCoulombMat> registeredMpmMohrCoulombMat(__FILE__);
