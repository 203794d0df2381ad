// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The background grid of an analysis in the current configuration, and what acts on the points there.
#include "engine/analysis/analysis.hpp"
#include "engine/output/vtkDataSets.hpp"

namespace yade {

// "grid": the cells with material; "ghostFaces": the faces that are stabilised; otherwise the picture of
// conditions of that kind (MpmCondition::picture): "loads", loaded surfaces; "walls", surfaces of boundaries;
// "contacts", where points touch rigid bodies. With their fields.
VtkCells gridCells(const string& kind, const Scene&, const Analysis&);

// For mpm.plot: the same as a dict of bytearrays, "corners" (cells x corners x 3 double) and "field", the first of the
// fields, and the "count" of cells.
py::dict gridCellsForPython(const string& kind, const Analysis&);

// For mpm.plot: ids of the rigid bodies that conditions act by.
py::list touchableBodiesForPython(const Analysis&);

// Kinds that conditions have, which every process has as a whole.
bool isOfConditions(const string& kind);

} // namespace yade
