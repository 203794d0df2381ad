// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmTrescaMat.hpp"
#include "yade_api/registration.hpp"

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmTrescaMat)
static const yade::PluginClasses<yade::MpmTrescaMat> registeredMpmTrescaMat(__FILE__);
