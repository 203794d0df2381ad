// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// MpmImplicitEngine.plotData(): numbers of the current state for YADE's plot.
#include "yade_api/types.hpp"

namespace yade {

void addPlotData(py::object pythonClass);

} // namespace yade
