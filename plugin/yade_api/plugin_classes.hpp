// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

namespace yade {

// Names of all classes that this plugin has made known to YADE's factory.
std::vector<std::string>& pluginClassNames();

} // namespace yade
