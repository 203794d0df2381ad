// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/convergence_test.hpp"
#include "core/stepping/outcome.hpp"

namespace gimpm {

/// Parts of the body are looked at when the whole is in balance.
template <int Dim> double ConvergenceTest<Dim>::excess(const Eigen::VectorXd& d, int solves)
{
	const double tolerance = settings().tolerance, ofWhole = relative(solves) / tolerance;
	isWholeInBalance_ = solves > 0 && ofWhole <= 1;
	if (!isWholeInBalance_) return ofWhole;
	report_.localResidual = localResidual(d);
	return std::max(ofWhole, report_.localResidual / (localTolerance * tolerance));
}

template <int Dim> bool ConvergenceTest<Dim>::ends(const Eigen::VectorXd& d, int solves, bool isComplete)
{
	const double residual = relative(solves);
	convergence.note(residual, excess(d, solves));
	report_.residuals = convergence.residuals();
	reportWorst(system_, iterate_.balance, report_);
	if (iterate_.failure) return fail(report_, *iterate_.failure);
	if (!std::isfinite(residual)) return fail(report_, Failure::notFinite, "the residual is not finite");
	// At least one solve: a load increment below the tolerance must not be lost.
	if (solves > 0 ? convergence.excess() <= 1 : residual == 0 && isComplete) return true;
	if (settings().interrupted && settings().interrupted()) return fail(report_, Failure::interrupted, "it was interrupted");
	if (convergence.hasStopped() && iterate_.balance.size <= iterate_.whole.roundOff(d))
		return fail(report_, Failure::stalled, causeOfStall(convergence, settings().tolerance));
	if (solves < settings().maxIterations) return false;
	return fail(report_, Failure::tooManyIterations, causeOfTooMany(report_, settings().tolerance, isWholeInBalance_, solves));
}

template <int Dim> bool ConvergenceTest<Dim>::improves(const Eigen::VectorXd& d, int solves, double before)
{
	return staysInBalance(solves) ? localResidual(d) < report_.localResidual : iterate_.balance.size < before;
}

template class ConvergenceTest<2>;
template class ConvergenceTest<3>;

} // namespace gimpm
