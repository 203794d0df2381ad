// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Boundaries on the lines of the grid.
#include "engine/conditions/boundary/MpmBoundary.hpp"
#include "engine/grid/fit.hpp"

namespace yade {

// The nodes that the boundaries constrain, of all bodies. std::invalid_argument names boundaries without nodes.
template <int Dim> vector<gimpm::ConstrainedBox<Dim>> heldBoxes(const vector<shared_ptr<MpmBoundary>>&, const MpmGrid&, const gimpm::Grid<Dim>&);

// std::invalid_argument for boxes of boundaries that prescribe a node two displacements.
template <int Dim> void refuseConflicts(const vector<gimpm::ConstrainedBox<Dim>>&, const vector<shared_ptr<MpmBoundary>>&);

} // namespace yade
