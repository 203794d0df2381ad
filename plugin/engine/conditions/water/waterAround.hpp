// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/analysis/analysis.hpp"

namespace yade {

// Averaged over boxes, as a step at O.time takes it: of each water of the engine the pressures [Pa] and their gradients
// [Pa/m], as bytearrays.
py::list waterAroundForPython(const Analysis&, const py::object& positions, const py::object& halfSizes);

} // namespace yade
