// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// MpmImplicitEngine.plotData(): numbers of the current state for YADE's plot.
#include "yade_api/types.hpp"

namespace yade {
class Analysis;

py::dict plotData(const Analysis&);

// The function of Python that calls it, with its documentation.
void addPlotData(py::object pythonClass, const py::object& function);

} // namespace yade
