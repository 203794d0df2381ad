// SPDX-License-Identifier: GPL-2.0-or-later
// Convergence, judged by the history of residuals.
#pragma once
#include <vector>

namespace gimpm {

/// Factor of the tolerance for the residual around a node over the forces there. Where the whole consists of one kind
/// of soil its norm shall decide: on the paper's largest slope the 160 steps then take 486 instead of 475 solves (with
/// 1: 507), 286 instead of 284 factorisations; its scenes of h = 1 m, where every iteration is a full one, take none
/// more.
constexpr double localTolerance = 3;

/// Residuals of the whole, and excesses: how far each iterate is from the end of the iteration, which has converged at
/// 1. The excess is the residual over the tolerance, or where the whole is in balance that of the part that is least
/// so.
class Convergence {
public:
	/// Admits reuse of the last factor in the last iterations, with reuseFactor.
	Convergence(double tolerance, bool reuseFactor) : tolerance_(tolerance), reuseFactor_(reuseFactor) { }

	void note(double residual, double excess) { residuals_.push_back(residual), excesses_.push_back(excess); }

	const std::vector<double>& residuals() const { return residuals_; }
	double                     residual() const { return residuals_.back(); }
	double                     excess() const { return excesses_.back(); }

	/// True if a solve with the last factor suffices: its error of K is that of the iteration before, so it reduces
	/// the residual about as much again.
	bool isLastFactorEnough() const { return suffices(excess(), reduction()); }

	/// No further stiffness will be needed after the next solve, of which the solver keeps a factor or not.
	bool isLastStiffness(bool keepsFactor) const;

	/// Part of the residual that an iterative solver may leave (inexact Newton): in proportion to the residual,
	/// which keeps the convergence quadratic, but no less than the step needs in the end; and just that if this
	/// solve is expected to be the last one.
	double forcing() const;

	/// True if small derivatives that are left out may be the cause that the last iteration has gained so little,
	/// or hardly more than the one before while many would have to follow.
	bool isSlow() const;

	/// True if several iterations have not halved what was left.
	bool hasStopped() const;

	/// The tolerance at which the best iterate so far would have converged.
	double attained() const;

private:
	double reduction() const;
	double expected() const;
	bool   suffices(double excess, double reduction) const { return reuseFactor_ && excess * reduction <= 1; }

	double              tolerance_;
	bool                reuseFactor_;
	std::vector<double> residuals_, excesses_;
};

} // namespace gimpm
