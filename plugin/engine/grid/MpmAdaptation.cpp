// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/grid/MpmAdaptation.hpp"
#include "yade_api/registration.hpp"

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmAdaptation)
static const yade::PluginClasses<yade::MpmAdaptation> registeredMpmAdaptation(__FILE__);
