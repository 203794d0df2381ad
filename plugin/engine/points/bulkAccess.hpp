// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Access of module mpm to all material points at once, far faster than body by body in Python.
#include "yade_api/yade_api.hpp"

namespace yade {

// Calls f while no step in the background changes the material points or the engines.
void betweenSteps(const py::object& f);

// Ids of all material points of the scene, in rising order: a bytearray of int64.
py::object idsOfPoints();

// For each column of mpm.arrays(), or also of those that follow from them, its values in order of body id, one row
// after the other, as a bytearray of double or int64: of the points that an engine with this mask moves. "materials" is
// the list of the bodies' own materials, "materialNumber" the place in it. With the columns `besides`, by their names,
// of points that others have.
py::dict columnsOfPoints(int mask, bool withDerived, const py::tuple& besides);

// Into YADE's log.
void warn(const string& text);

} // namespace yade
