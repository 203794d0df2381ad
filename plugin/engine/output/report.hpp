// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// MpmImplicitEngine.report(): how the last run went. One table of keys makes the answer, its docstring and the page of
// the reference.
#include "yade_api/types.hpp"

namespace yade {
class Analysis;

py::dict report(const Analysis&);

// The function of Python that calls it, with its documentation.
void addReport(py::object pythonClass, const py::object& function);

} // namespace yade
