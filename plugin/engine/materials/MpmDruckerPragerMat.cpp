// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmDruckerPragerMat.hpp"
#include "yade_api/registration.hpp"

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmDruckerPragerMat)
static const yade::PluginClasses<yade::MpmDruckerPragerMat> registeredMpmDruckerPragerMat(__FILE__);
