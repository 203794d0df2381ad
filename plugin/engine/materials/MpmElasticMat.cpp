// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmElasticMat.hpp"
#include "yade_api/registration.hpp"

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmElasticMat)
static const yade::PluginClasses<yade::MpmElasticMat> registeredMpmElasticMat(__FILE__);
