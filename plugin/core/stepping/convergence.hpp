// SPDX-License-Identifier: GPL-2.0-or-later
// Convergence test of Newton's method, and what the history of residuals tells of the solves to come.
#pragma once
#include "core/stepping/outcome.hpp"
#include "core/stepping/residual.hpp"

namespace gimpm {

/// Residuals |r_i| / |external forces + reactions| and excesses e_i, by iterate. The excess tells how far the iterate
/// is from the end of the iteration, which has converged at 1.
class ConvergenceHistory {
public:
	/// `reuseFactor`: admits solves with the last factor.
	ConvergenceHistory(double tolerance, bool reuseFactor) : tolerance_(tolerance), reuseFactor_(reuseFactor) { }

	void note(double residual, double excess) { residuals_.push_back(residual), excesses_.push_back(excess); }

	/// Reductions up to now, by another method, tell nothing of those to come.
	void changeMethod() { first_ = residuals_.size() - 1; }

	const std::vector<double>& residuals() const { return residuals_; }
	double                     residual() const { return residuals_.back(); }
	double                     excess() const { return excesses_.back(); }

	/// True if a solve with the last factor suffices: its error of K is that of the iteration before, so it reduces
	/// the residual about as much again.
	bool isLastFactorEnough() const { return suffices(excess(), reduction()); }

	/// True if no further Jacobian will be needed after the next solve, of which the solver keeps a factor or not.
	bool isLastJacobian(bool keepsFactor) const { return expected() <= 1 || (keepsFactor && suffices(expected(), std::pow(reduction(), 2))); }

	/// Part of the residual that an iterative solver may leave (inexact Newton): in proportion to the residual,
	/// which keeps the convergence quadratic, but no less than the step needs in the end; and just that if this
	/// solve is expected to be the last one.
	double forcing() const
	{
		constexpr double first = 1e-3, part = 0.1, attainable = 1e-13;
		const double     enough = excess() > 0 ? part / excess() : first;
		const double     wanted = expected() <= 1 ? enough : std::max(part * residual(), enough);
		return std::max(attainable, std::min(first, wanted));
	}

	/// True if small derivatives that are left out may be the cause that the last iteration has gained so little,
	/// or hardly more than the one before while many would have to follow.
	bool isSlow() const
	{
		constexpr double slow = 0.1, alike = 0.3, many = 3; // limits for going on: Newton's iterations are few
		const auto&      r = residuals_;
		if (r.size() < first_ + 3) return false;
		const double before = r[r.size() - 2] / r[r.size() - 3];
		return reduction() > slow || (reduction() > alike * before && std::log(excess()) > -many * std::log(reduction()));
	}

	/// True if several iterations have not halved what was left.
	bool hasStopped() const
	{
		constexpr int several = 4;
		if (int(excesses_.size()) <= several) return false;
		const auto before = excesses_.end() - several;
		return *std::min_element(before, excesses_.end()) > 0.5 * *std::min_element(excesses_.begin(), before);
	}

	/// Tolerance at which the best iterate so far would have converged.
	double attained() const { return tolerance_ * *std::min_element(excesses_.begin(), excesses_.end()); }

private:
	/// Factor by which the last iteration reduced the residual; 1 if it did not.
	double reduction() const { return residuals_.size() < first_ + 2 ? 1 : std::min(1., residual() / residuals_[residuals_.size() - 2]); }
	/// Excess that quadratic convergence leads to in the next iteration.
	double expected() const { return excess() * std::pow(reduction(), 2); }
	bool   suffices(double excess, double reduction) const { return reuseFactor_ && excess * reduction <= 1; }

	double              tolerance_;
	bool                reuseFactor_;
	std::vector<double> residuals_, excesses_;
	std::size_t         first_ = 0; ///< iterate of the method
};

/// Tests the iterates one after the other. With the tolerance t,
///
///     |r| <= t |f_ext + reactions|        of the whole body (Residual::relative)
///     |r| <= localTolerance t |forces|    around each node (Residual::local), when the whole is in balance
///
/// after at least one solve. The iteration fails where r is no number, has come down to round-off, or after as many
/// solves as are allowed.
template <int Dim> class ConvergenceTest {
public:
	/// All are kept by reference.
	ConvergenceTest(const StepSystem<Dim>& system, Residual<Dim>& residual, StepReport& report)
	        : history(system.model.newton.tolerance, system.model.newton.reuseFactor), system_(system), residual_(residual), report_(report)
	{
	}

	ConvergenceHistory history;

	/// True if the iterate at d is the last one: it has converged, or the report says why not. `isComplete`: d has
	/// the prescribed growth.
	bool ends(const Eigen::VectorXd& d, bool isComplete)
	{
		++solves_;
		const double relative = this->relative();
		history.note(relative, excess(d, relative));
		report_.residuals = history.residuals();
		reportWorst(system_, residual_, report_);
		if (residual_.failure) return fail(report_, *residual_.failure);
		if (!std::isfinite(relative)) return fail(report_, Failure::notFinite, "the residual is not finite");
		// At least one solve: a load increment below the tolerance must not be lost.
		if (solves_ > 0 ? history.excess() <= 1 : relative == 0 && isComplete) return true;
		if (settings_.interrupted && settings_.interrupted()) return fail(report_, Failure::interrupted, "it was interrupted");
		if (history.hasStopped() && residual_.isRoundOff(d))
			return fail(report_, Failure::stalled, causeOfStall(relative, history.attained(), settings_.tolerance));
		if (!isLast(0)) return false;
		return fail(report_, Failure::tooManyIterations, causeOfTooMany(report_, settings_.tolerance, isWholeInBalance_, solves_));
	}

	int solves() const { return solves_; } ///< number of solves that have led to the last iterate

	/// The next solve takes the factor of an earlier step: it does not count among those allowed.
	void allowAnother() { ++more_; }

	/// True if no more are allowed after so many others.
	bool isLast(int others) const { return solves_ + others >= settings_.maxIterations + more_; }

	/// |r| / |external forces + reactions|
	double relative() const { return residual_.relative(solves_ > 0); }

	/// True if the whole was in balance at the last iterate, and is so at the last evaluation.
	bool staysInBalance() const { return isWholeInBalance_ && relative() <= settings_.tolerance; }

	/// True if the last evaluation, at d, is closer to equilibrium than the last iterate, with the norm `before`:
	/// in the part that is least in balance, when the whole is.
	bool improves(const Eigen::VectorXd& d, double before) { return staysInBalance() ? localResidual(d) < report_.localResidual : residual_.norm < before; }

private:
	/// Residual over the tolerance or, where the whole is in balance, that of the part that is least so.
	double excess(const Eigen::VectorXd& d, double relative)
	{
		const double ofWhole = relative / settings_.tolerance;
		isWholeInBalance_    = solves_ > 0 && ofWhole <= 1;
		if (!isWholeInBalance_) return ofWhole;
		report_.localResidual = localResidual(d);
		return std::max(ofWhole, report_.localResidual / (localTolerance * settings_.tolerance));
	}
	double localResidual(const Eigen::VectorXd& d) { return residual_.local(d, localTolerance * settings_.tolerance); }

	const StepSystem<Dim>& system_;
	Residual<Dim>&         residual_;
	StepReport&            report_;
	const NewtonSettings&  settings_         = system_.model.newton;
	int                    solves_           = -1;
	int                    more_             = 0; // solves than maxIterations
	bool                   isWholeInBalance_ = false;
};

} // namespace gimpm
