// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The surfaces that an engine's loads act on, and those that hold, as VTK data.
#include "engine/analysis/Loads.hpp"
#include "engine/conditions/boundary/MpmBoundary.hpp"
#include "engine/output/vtkDataSets.hpp"

namespace yade {

// Their pieces, segments with dim=2 and triangles with dim=3: `load`, the number of the load; `traction`, force over current area at this time [Pa].
VtkCells loadedSurfaces(const Loads&, Real time, int dim);

// The same of boundaries that are walls: `boundary`, the number of the boundary; `traction`, by which it holds the body in the last converged state [Pa].
VtkCells walls(const vector<shared_ptr<MpmBoundary>>&, int dim);

} // namespace yade
