// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The one way from the settings of an engine and its scene to what the core computes with: of a run, of a study and of
// the limit of explicit steps, so that whatever acts in the one acts in the others.
#include "engine/analysis/analysis.hpp"
#include "engine/engines/job.hpp"
#include <functional>

namespace yade {

// Puts the points into the cloud of a setup, the model of which has its settings, and their materials into the model.
template <int Dim> using TakePoints = std::function<void(Setup<Dim>&)>;

// For load steps from one load time to another, the points of which come to stand in `points`. All but inertia, which
// comes last. std::invalid_argument names what cannot be computed with.
template <int Dim> Setup<Dim> buildModel(const Analysis&, const Scene&, const vector<MaterialPoint>& points, Real begin, Real target, const TakePoints<Dim>&);

// Sets and returns the load of the next step.
template <int Dim> gimpm::Load<Dim> advance(Setup<Dim>&, const Analysis&, const StepTime&);

// The state of the scene as it is: what a load step from here begins with, and loads that stay as they are. The points
// may be divided among processes.
template <int Dim> struct CurrentState : Setup<Dim> {
	gimpm::Load<Dim> load;
};
template <int Dim> CurrentState<Dim> currentState(const Analysis&, const std::shared_ptr<gimpm::Division>& = std::make_shared<gimpm::Division>());

} // namespace yade
