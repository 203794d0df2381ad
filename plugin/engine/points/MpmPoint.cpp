// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/points/MpmPoint.hpp"
#include "yade_api/registration.hpp"

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmPoint)
static const yade::PluginClasses<yade::MpmPoint> registeredMpmPoint(__FILE__);
