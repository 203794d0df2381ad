// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Boundaries off the lines of the grid.
#include "core/stepping/model.hpp"
#include "engine/conditions/boundary/MpmBoundary.hpp"

namespace yade {

// std::invalid_argument, in the name given, for a boundary with a surface that cannot be computed with. `smallestCell`:
// size that there may be, whatever cells are halved in this step [m].
template <int Dim> std::shared_ptr<gimpm::Wall<Dim>> wallOf(const MpmBoundary&, const string& name, const gimpm::Model<Dim>&, Real smallestCell);

} // namespace yade
