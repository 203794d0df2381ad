// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Boundaries off the lines of the grid, between a scene and the core.
#include "core/stepping/model.hpp"
#include "engine/conditions/boundary/MpmBoundary.hpp"

namespace yade {

// Adds them to a model. std::invalid_argument names what cannot be computed with.
template <int Dim> void addWalls(const vector<shared_ptr<MpmBoundary>>&, gimpm::Model<Dim>&);

// By how much they move in the next step, of this duration [s]; whether any does.
template <int Dim> bool moveWalls(const vector<shared_ptr<MpmBoundary>>&, gimpm::Model<Dim>&, Real duration);

// Writes a converged state back.
template <int Dim> void scatterWalls(const gimpm::Model<Dim>&, const vector<shared_ptr<MpmBoundary>>&);

} // namespace yade
