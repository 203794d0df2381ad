// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The background grid of an analysis in the current configuration, as an engine sees it.
#include "engine/engines/MpmImplicitEngine.hpp"
#include "engine/output/vtkDataSets.hpp"

namespace yade {

// "grid": the cells that hold material; "ghostFaces": the faces that are stabilised; "loads": loaded surfaces; "walls": surfaces of boundaries; "contacts": where points touch rigid bodies. With their fields.
VtkCells gridCells(const string& kind, const Scene&, const MpmImplicitEngine&);

// For mpm.plot: the same as a dict of bytearrays, "corners" (cells x corners x 3 double) and "field", the first of the fields.
py::dict gridCellsForPython(const string& kind, const shared_ptr<MpmImplicitEngine>&);

} // namespace yade
