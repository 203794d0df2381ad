// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/grid/MpmRefinement.hpp"
#include "yade_api/registration.hpp"

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmRefinement)
static const yade::PluginClasses<yade::MpmRefinement> registeredMpmRefinement(__FILE__);
