// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/MpmNewton.hpp"

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmNewton)
static const yade::PluginClasses<yade::MpmNewton> registeredMpmNewton(__FILE__);
