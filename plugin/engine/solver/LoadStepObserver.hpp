// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace yade {
class MpmImplicitEngine;

// An engine that follows the load steps of an MpmImplicitEngine, which tells all of them among O.engines, wherever they stand.
class LoadStepObserver {
public:
	virtual ~LoadStepObserver() = default;

	// The scene has been found fit for computing, and is in the state where the step starts.
	virtual void stepBegins(const MpmImplicitEngine&) = 0;

	// The scene is in the state that the step has reached; without convergence that is the state where it started.
	virtual void stepEnds(const MpmImplicitEngine&, bool converged) = 0;
};

} // namespace yade
