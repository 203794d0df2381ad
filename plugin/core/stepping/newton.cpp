// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/newton.hpp"
#include "core/stepping/convergence.hpp"
#include "core/stepping/iterate.hpp"
#include "core/stepping/line_search.hpp"
#include "core/stepping/linear_step.hpp"
#include "core/stepping/outcome.hpp"

namespace gimpm {
namespace {

/// A prediction may start from this many times the residual of zero: where only little load is added in a step, its residual may be the
/// larger one, and it is still much closer to the solution in what counts, which points yield. On the largest slope of the paper, starting
/// from the smaller residual takes 493 solves, this 387, and zero 752.
constexpr double toleratedStart = 2;

template <int Dim> class Newton {
public:
	Newton(const StepSystem<Dim>& system, LinearSolver& solver, StepReport& report)
	        : system_(system)
	        , settings_(system.model.newton)
	        , report_(report)
	        , iterate_(system, report)
	        , linear_(system, solver, report)
	        , convergence_(settings_.tolerance, settings_.reuseFactor)
	        , d_(Eigen::VectorXd::Zero(system.nodalSize()))
	{
	}

	/// Starts from zero, or from the prediction (which may be empty) if that is not much further from equilibrium.
	Eigen::VectorXd run(const Eigen::VectorXd& prediction)
	{
		const bool predicts = prediction.size() > 0;
		iterate_.evaluate(d_, !predicts);
		iterate_.whole.begin(iterate_.balance);
		if (predicts) startFrom(prediction);
		while (!finished() && correct())
			++iterations_;
		report_.iterations += iterations_;
		report_.reactions = reactions(system_, iterate_.force);
		return d_;
	}
	bool hasPredicted() const { return predicted_; }

private:
	/// Takes the prediction as the start unless its residual is much the larger one. Zero is given the prescribed displacements for that,
	/// without which its residual says nothing of them.
	void startFrom(Eigen::VectorXd prediction)
	{
		const Eigen::VectorXd& held = system_.prescribed;
		if (linear_.prescribes()) iterate_.evaluate(held, false);
		const double fromZero = iterate_.balance.size;
		for (int i = 0; i < prediction.size(); ++i)
			if (system_.dofs.number[i] < 0) prediction[i] = held[i];
		iterate_.evaluate(prediction, true);
		predicted_ = iterate_.balance.size < toleratedStart * fromZero;
		if (!predicted_) return iterate_.evaluate(d_, true);
		d_ = std::move(prediction);
		if (linear_.prescribes()) iterate_.whole.enter(iterate_.balance);
		linear_.hasPrescribed();
	}

	double relative() const { return iterate_.whole.relative(iterate_.balance, iterations_ > 0); }

	/// How far the iteration is from its end: converged at 1. Parts of the body are looked at when the whole is in balance.
	double excess()
	{
		const double ofWhole = relative() / settings_.tolerance;
		isWholeInBalance_    = iterations_ > 0 && ofWhole <= 1;
		if (!isWholeInBalance_) return ofWhole;
		report_.localResidual = localResidual(d_);
		return std::max(ofWhole, report_.localResidual / (localTolerance * settings_.tolerance));
	}
	double localResidual(const Eigen::VectorXd& d) { return iterate_.localResidual(d, localTolerance * settings_.tolerance); }

	bool finished()
	{
		const double residual = relative();
		convergence_.note(residual, excess());
		report_.residuals = convergence_.residuals();
		reportWorst(system_, iterate_.balance, report_);
		// At least one solve: a load increment below the tolerance must not be lost.
		const bool converged = iterations_ > 0 ? convergence_.excess() <= 1 : residual == 0 && !linear_.prescribes();
		if (iterate_.failure) return fail(report_, *iterate_.failure);
		if (!std::isfinite(residual)) return fail(report_, Failure::notFinite, "the residual is not finite");
		if (converged) return true;
		if (settings_.interrupted && settings_.interrupted()) return fail(report_, Failure::interrupted, "it was interrupted");
		if (convergence_.hasStopped() && iterate_.balance.size <= iterate_.whole.roundOff(d_))
			return fail(report_, Failure::stalled, causeOfStall(convergence_, settings_.tolerance));
		if (iterations_ < settings_.maxIterations) return false;
		return fail(report_, Failure::tooManyIterations, causeOfTooMany(report_, settings_.tolerance, isWholeInBalance_, iterations_));
	}

	/// One solve and the step that it gives. False if the iteration has to end.
	bool correct()
	{
		if (linear_.keepsFactor() && !watchdog_.isOpen() && convergence_.isLastFactorEnough() && reuse()) return true;
		if (!iterate_.hasStiffness) iterate_.evaluate(d_, true);
		// Prescribed displacements enter in full: the residual before says nothing of them, and a shorter step would lose a part.
		const bool      prescribes = linear_.prescribes();
		const double    before     = iterate_.balance.size;
		Eigen::VectorXd step;
		if (!linear_.solve(iterate_.K, iterate_.balance.residual, convergence_.forcing(), step)) {
			if (watchdog_.isOpen()) return goBack();
			return !fail(report_, Failure::singular, "the stiffness matrix is singular to working precision");
		}
		iterate_.evaluate(d_ + step, !convergence_.isLastStiffness(linear_.keepsFactor()));
		const double& after = iterate_.balance.size;
		if (staysInBalance()) {
			// the whole had converged before, and the step is for a part of it: what is left of the whole says nothing of that
		} else if (predicted_ && !(after < before)) { // and zero is tried
			return !fail(report_, Failure::diverging, "the prediction leads nowhere");
		} else if (watchdog_.isOpen()) {
			if (!watchdog_.admits(after)) return goBack();
		} else if (!prescribes && !(after < toleratedGrowth * before)) {
			if (!mayGoOn()) return search(d_, step, before, after);
			watchdog_.begin(d_, step, before, after);
		}
		if (prescribes) iterate_.whole.enter(iterate_.balance);
		d_ += step;
		return true;
	}
	/// Whether the whole was in balance before this step and is so after it.
	bool staysInBalance() const { return isWholeInBalance_ && relative() <= settings_.tolerance; }

	/// One step of the modified Newton method, with the last factor. Nothing is changed unless it reduces the residual.
	bool reuse()
	{
		Eigen::VectorXd step;
		const double    before = iterate_.balance.size;
		if (!linear_.solveAgain(iterate_.balance.residual, step)) return false;
		iterate_.evaluate(d_ + step, false);
		if (!(staysInBalance() ? localResidual(d_ + step) < report_.localResidual : iterate_.balance.size < before)) {
			linear_.dropFactor();
			iterate_.evaluate(d_, true);
			return false;
		}
		++report_.reusedFactors;
		d_ += step;
		return true;
	}

	bool mayGoOn() const
	{
		return settings_.lineSearchTrials > 0 && !watchdog_.wasVain() && std::isfinite(iterate_.balance.size) && iterations_ + 1 < settings_.maxIterations;
	}
	bool goBack()
	{
		watchdog_.giveUp();
		return search(watchdog_.from, watchdog_.step, watchdog_.before, watchdog_.raised);
	}

	/// A full step from d raised the residual to `full`.
	bool search(const Eigen::VectorXd& d, const Eigen::VectorXd& step, double before, double full)
	{
		const Shortened best = lineSearch(before, full, settings_.lineSearchTrials, [&](double part) {
			iterate_.evaluate(d + part * step, false);
			return iterate_.balance.size;
		});
		report_.lineSearchTrials += best.trials;
		const double length = best.length * step.template lpNorm<Eigen::Infinity>();
		if (settings_.lineSearchTrials > 0 && best.size >= before && length > system_.model.grid.cellSize) {
			report_.residuals.push_back(relative());
			return !fail(report_, Failure::diverging, causeOfDivergence(length));
		}
		d_ = d + best.length * step;
		iterate_.evaluate(d_, true);
		return true;
	}

	const StepSystem<Dim>& system_;
	const NewtonSettings&  settings_;
	StepReport&            report_;
	Iterate<Dim>           iterate_;
	LinearStep<Dim>        linear_;
	Convergence            convergence_;
	Watchdog               watchdog_;
	Eigen::VectorXd        d_;
	int                    iterations_ = 0;
	bool                   predicted_ = false, isWholeInBalance_ = false;
};

} // namespace

template <int Dim>
Eigen::VectorXd equilibrium(const StepSystem<Dim>& system, LinearSolver& solver, StepReport& report, const Eigen::VectorXd& prediction)
{
	if (prediction.size() > 0) {
		StepReport      attempt = report;
		Newton<Dim>     newton(system, solver, attempt);
		Eigen::VectorXd d = newton.run(prediction);
		if (attempt.converged() || attempt.failure == Failure::interrupted || !newton.hasPredicted()) {
			attempt.predicted = newton.hasPredicted();
			report            = std::move(attempt);
			return d;
		}
		report.takeEffort(attempt);
	}
	return Newton<Dim>(system, solver, report).run({});
}

template Eigen::VectorXd equilibrium(const StepSystem<2>&, LinearSolver&, StepReport&, const Eigen::VectorXd&);
template Eigen::VectorXd equilibrium(const StepSystem<3>&, LinearSolver&, StepReport&, const Eigen::VectorXd&);

} // namespace gimpm
