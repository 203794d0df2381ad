// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Messages through YADE's log: shown, filtered by class name and redirected like those of YADE itself (module
// yade.log).
#include <string>

namespace yade {
enum class Severity { fatal = 1, error, warning, info, debug, trace }; // YADE's values

void log(Severity severity, const std::string& className, const std::string& message);
} // namespace yade
