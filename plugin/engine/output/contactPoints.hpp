// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Where material points touch rigid bodies, as VTK data.
#include "engine/conditions/contact/MpmContact.hpp"
#include "engine/output/vtkDataSets.hpp"

namespace yade {
class MpmImplicitEngine;

// A vertex for each corner that touches: `force` on the soil [N]; `gap` [m], < 0 by the penalty; `slips`, 1 at the limit of friction; `body`, its id.
VtkCells contactPoints(const vector<shared_ptr<MpmContact>>&);

// For mpm.plot: ids of the rigid bodies that the contacts mean.
py::list touchableBodiesForPython(const shared_ptr<MpmImplicitEngine>&);

} // namespace yade
