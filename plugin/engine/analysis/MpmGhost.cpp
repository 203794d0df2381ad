// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/analysis/MpmGhost.hpp"
#include "yade_api/registration.hpp"

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmGhost)
static const yade::PluginClasses<yade::MpmGhost> registeredMpmGhost(__FILE__);
