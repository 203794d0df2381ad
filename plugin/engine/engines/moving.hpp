// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Inertia in the steps of a run.
#include "core/terms/motion.hpp"
#include "engine/analysis/job.hpp"
#include "engine/conditions/shaking/shaking.hpp"

namespace yade {
class MpmDynamicEngine;

template <int Dim> class Moving {
public:
	// Takes the velocities over and makes inertia act in the job's model, after everything else. std::invalid_argument names a velocity that cannot be
	// computed with.
	Moving(MpmDynamicEngine&, Job<Dim>&, const vector<MaterialPoint>&);

	// The next step goes from here to the time of the attempt.
	void begin(Job<Dim>&, Attempt<Dim>&, Real from) const;

	// Makes an explicit step.
	gimpm::StepReport step(Job<Dim>&, const Attempt<Dim>&) const;

	// Adds up what the step that has been accepted has worked, while the points are still as before it, and gives them their velocities.
	void reach(const Job<Dim>&, Real time, const vector<MaterialPoint>&);

	// A sentence where contact has given much energy that nobody has put in.
	string doubtOfContact() const;

private:
	void addWork(const Job<Dim>&, Real time, const vector<MaterialPoint>&);
	Real workOfBoundaries(Real from, Real time) const;
	Real energyComeIn() const;

	MpmDynamicEngine&                   engine;
	Real                                energy; // of the points of this process before the first step; 0 where that has been made
	std::shared_ptr<gimpm::Motion<Dim>> motion;
	std::unique_ptr<Shaking<Dim>>       shaking;
};

} // namespace yade
