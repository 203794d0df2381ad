// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Boundaries on the lines of the grid.
#include "engine/conditions/boundary/MpmBoundary.hpp"
#include "engine/grid/fit.hpp"

namespace yade {

// The nodes that the boundaries hold. std::invalid_argument names boundaries that hold none, or contradict each other.
template <int Dim> vector<gimpm::HeldBox<Dim>> heldBoxes(const vector<shared_ptr<MpmBoundary>>&, const MpmGrid&, const gimpm::Grid<Dim>&);

} // namespace yade
