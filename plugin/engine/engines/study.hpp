// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Methods of MpmImplicitEngine that study the current state and leave it alone: stiffness(), conditionNumber(),
// conditionEstimate() and workload().
#include "yade_api/types.hpp"

namespace yade {

void addStudyMethods(py::object pythonClass);

} // namespace yade
