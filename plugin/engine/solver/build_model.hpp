// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The one way from the settings of an engine and its scene to what the core computes with: of a run, of a study and of
// the limit of explicit steps, so that whatever acts in the one acts in the others.
#include "engine/solver/job.hpp"
#include <functional>

namespace yade {

class MpmImplicitEngine;

// The grid, what holds its nodes, and how it is solved; without points and without what acts on them.
template <int Dim> gimpm::Model<Dim> emptyModel(const MpmImplicitEngine&);

// Puts the points into the cloud of a setup, the model of which has its settings, and their materials into the model.
template <int Dim> using TakePoints = std::function<void(Setup<Dim>&)>;

// For load steps from one load time to another, the points of which come to stand in `points`. All but inertia, which
// comes last. std::invalid_argument names what cannot be computed with.
template <int Dim>
Setup<Dim> buildModel(MpmImplicitEngine&, const Scene&, const vector<MaterialPoint>& points, Real begin, Real target, const TakePoints<Dim>&);

// The next step goes from here to there. Whether something moves by its velocity.
template <int Dim> bool advance(Setup<Dim>&, const MpmImplicitEngine&, Real from, Real to);

// The state of the scene as it is: what a load step from here begins with, and loads that stay as they are. The points
// may be divided among processes.
template <int Dim> Setup<Dim> currentState(MpmImplicitEngine&, const std::shared_ptr<gimpm::Division>& = std::make_shared<gimpm::Division>());

} // namespace yade
