// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmVonMisesMat.hpp"

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmVonMisesMat)
static const yade::PluginClasses<yade::MpmVonMisesMat> registered(__FILE__);
