// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/stepping/model.hpp"
#include "core/stepping/report.hpp"
#include "engine/engines/job.hpp"

namespace yade {
class MpmImplicitEngine;

// Effect of newton.stepTolerance on the load steps of a run.
class StepErrors {
public:
	explicit StepErrors(const MpmImplicitEngine&); // made once a run begins

	// The load step that is to be tried now, as nextIncrement() makes it. Where loads begin to grow, or turn, no
	// step before tells what the tolerance admits: there it is a small one.
	template <int Dim, class F> Attempt<Dim> next(Job<Dim>& job, F&& nextIncrement) const
	{
		Attempt<Dim> tried = nextIncrement();
		const double grows = tried.load.growth();
		if (tolerance > 0 && grows != 0 && !(tried.last.load * grows > 0)) {
			job.control.beginAnew();
			tried = nextIncrement();
		}
		job.model.newton.stepTolerance = tolerance > 0 && !job.control.isLeast() ? tolerance : gimpm::NewtonSettings().stepTolerance;
		return tried;
	}

	// Warning of steps which come next and cannot be made smaller, once in a run; empty if there are none.
	string warningOf(const gimpm::StepReport&, const gimpm::StepControl& next);

private:
	const MpmImplicitEngine& engine;
	Real                     tolerance;
	bool                     isTold = false;
};

} // namespace yade
