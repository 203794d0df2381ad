// SPDX-License-Identifier: GPL-2.0-or-later
// When the iteration of a step is at its end.
#pragma once
#include "core/stepping/convergence.hpp"
#include "core/stepping/iterate.hpp"

namespace gimpm {

/// Looks at the iterates of Newton's method one after the other. Solves: how many have led to the iterate.
template <int Dim> class ConvergenceTest {
public:
	ConvergenceTest(const StepSystem<Dim>& system, Iterate<Dim>& iterate, StepReport& report)
	        : convergence(system.model.newton.tolerance, system.model.newton.reuseFactor), system_(system), iterate_(iterate), report_(report)
	{
	}
	/// True if the iterate at d is the last one: it has converged, or the report says why not. `isComplete`: d has
	/// the prescribed displacements.
	bool ends(const Eigen::VectorXd& d, int solves, bool isComplete);

	/// |residual| / |external forces + reactions|
	double relative(int solves) const { return iterate_.whole.relative(iterate_.balance, solves > 0); }

	/// True if the whole was in balance at the iterate before, and is so at this one.
	bool staysInBalance(int solves) const { return isWholeInBalance_ && relative(solves) <= settings().tolerance; }

	/// True if this iterate is closer to equilibrium than the one before, with a residual of `before`: in the part
	/// that is least in balance, when the whole is.
	bool improves(const Eigen::VectorXd& d, int solves, double before);

	Convergence convergence;

private:
	const NewtonSettings& settings() const { return system_.model.newton; }
	double                excess(const Eigen::VectorXd& d, int solves);
	double                localResidual(const Eigen::VectorXd& d) { return iterate_.localResidual(d, localTolerance * settings().tolerance); }

	const StepSystem<Dim>& system_;
	Iterate<Dim>&          iterate_;
	StepReport&            report_;
	bool                   isWholeInBalance_ = false;
};

} // namespace gimpm
