// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// MpmImplicitEngine.report(): how the last run went.
#include "yade_api/types.hpp"

namespace yade {

void addReport(py::object pythonClass);

} // namespace yade
