// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/MpmGrid.hpp"

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmGrid)
static const yade::PluginClasses<yade::MpmGrid> registered(__FILE__);
