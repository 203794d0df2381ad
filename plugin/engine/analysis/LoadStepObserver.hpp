// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/scene.hpp"

namespace yade {
class Analysis;

// An engine that follows the load steps of an MpmImplicitEngine, which tells all of them among O.engines, wherever they
// stand.
class LoadStepObserver {
public:
	virtual ~LoadStepObserver() = default;

	// The scene has been found fit for computing, and is in the state where the step starts.
	virtual void stepBegins(const Analysis&) = 0;

	// The scene is in the state that the step has reached; without convergence that is the state where it started.
	virtual void stepEnds(const Analysis&, bool converged) = 0;
};

template <class F> void tellObservers(Scene& scene, F tell)
{
	for (const auto& engine : scene.engines)
		if (auto* observer = dynamic_cast<LoadStepObserver*>(engine.get()); observer && !engine->dead) {
			engine->scene = &scene;
			tell(*observer);
		}
}

} // namespace yade
