// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Inertia in the steps of a run.
#include "core/terms/inertia/motion.hpp"
#include "core/terms/inertia/rayleigh.hpp"
#include "engine/engines/job.hpp"

namespace yade {
class MpmDynamicEngine;

template <int Dim> class Moving {
public:
	// Takes the velocities over and makes inertia act in the job's model, after everything else.
	// std::invalid_argument names a velocity that cannot be computed with.
	Moving(MpmDynamicEngine&, Job<Dim>&, const vector<MaterialPoint>&);

	// The next step goes from one time to another.
	StepTime begin(Job<Dim>&, Real from, Real to) const;

	// Takes the load at the instant at which the scheme in time evaluates it.
	void weigh(gimpm::Load<Dim>&) const;

	// Makes an explicit step.
	gimpm::StepReport step(Job<Dim>&, const Attempt<Dim>&) const;

	// Adds up what the step that has been accepted has worked, while the points are still as before it, and gives
	// them their velocities.
	void reach(const Job<Dim>&, const StepOutcome<Dim>&);

	// A sentence where contact has given much energy that nobody has put in.
	string warningOfContact() const;

private:
	void joinRayleigh(const Job<Dim>&);
	void addWork(const Job<Dim>&, const StepOutcome<Dim>&);
	Real energyComeIn() const;

	MpmDynamicEngine& engine;
	// Energy of the points of this process before the first step; 0 where that has been made.
	Real                                energy;
	std::shared_ptr<gimpm::Motion<Dim>> motion;
	std::shared_ptr<gimpm::Rayleigh>    rayleigh { new gimpm::Rayleigh };
};

} // namespace yade
