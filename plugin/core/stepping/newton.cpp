// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/newton.hpp"
#include "core/stepping/convergence_test.hpp"
#include "core/stepping/ghost_share.hpp"
#include "core/stepping/line_search.hpp"
#include "core/stepping/linear_step.hpp"
#include "core/stepping/outcome.hpp"
#include "core/stepping/start.hpp"

namespace gimpm {
namespace {

template <int Dim> class Newton {
public:
	Newton(const StepSystem<Dim>& system, LinearSolver& solver, StepReport& report) : system_(system), report_(report), linear_(system, solver, report) { }

	NewtonResult run(const Eigen::VectorXd& prediction)
	{
		predicted_ = Start<Dim>(system_, iterate_, linear_).from(prediction, d_);
		while (!convergenceTest_.ends(d_, solves_, !linear_.prescribes()) && correct())
			++solves_;
		report_.iterations += solves_;
		report_.reactions  = reactions(system_, iterate_.force);
		report_.looseForce = looseForce(system_, iterate_.force);
		if (report_.converged()) report_.ghostShare = ghostShare(system_, d_, iterate_.force);
		return { std::move(d_), predicted_ };
	}

private:
	/// One solve and the step that it gives. False if the iteration has to end.
	bool correct()
	{
		if (linear_.keepsFactor() && !watchdog_.isOpen() && convergenceTest_.convergence.isLastFactorEnough() && reuse()) return true;
		if (convergenceTest_.convergence.isSlow() && system_.makeExact()) iterate_.prepare();
		if (!iterate_.hasStiffness) iterate_.evaluate(d_, true);
		// Prescribed displacements enter in full: the residual before says nothing of them, and a shorter step
		// would lose a part.
		const bool prescribes = linear_.prescribes();
		NewtonStep next;
		next.from       = d_;
		next.sizeBefore = iterate_.balance.size;
		if (!linear_.solve(iterate_.K, iterate_.couplingBlocks, iterate_.balance.residual, convergenceTest_.convergence.forcing(), next.step)) {
			if (watchdog_.isOpen()) return goBack();
			return !fail(report_, Failure::singular, "the stiffness matrix is singular to working precision");
		}
		next.before = workOn(next.step);
		next.length = system_.map.displacements(next.step).template lpNorm<Eigen::Infinity>();
		// Matrices of several fields cost so much more than residuals that it is first seen whether one is
		// needed.
		iterate_.evaluate(d_ + next.step, system_.map.isAlone() && !convergenceTest_.convergence.isLastStiffness(linear_.keepsFactor()));
		next.after = workOn(next.step), next.size = iterate_.balance.size;
		if (convergenceTest_.staysInBalance(solves_)) {
			// the whole had converged before, and the step is for a part of it: what is left of the whole
			// says nothing of that
		} else if (watchdog_.isOpen()) {
			if (!watchdog_.admits(next.size)) return goBack();
		} else if (!prescribes && !next.isTaken(system_.model.grid.cellSize) && settings_.lineSearchTrials > 0) {
			if (!mayGoOn()) return search(next);
			watchdog_.begin(next);
		}
		if (prescribes) iterate_.enter(linear_.causedByPrescribed());
		d_ += next.step;
		return true;
	}

	/// One step of the modified Newton method, with the last factor. Nothing is changed unless it reduces the
	/// residual.
	bool reuse()
	{
		Eigen::VectorXd step;
		const double    before = iterate_.balance.size;
		if (!linear_.solveAgain(iterate_.balance.residual, step)) return false;
		iterate_.evaluate(d_ + step, false);
		if (!convergenceTest_.improves(d_ + step, solves_, before)) {
			linear_.dropFactor();
			iterate_.evaluate(d_, true);
			return false;
		}
		++report_.reusedFactors;
		d_ += step;
		return true;
	}

	/// Work of the out-of-balance force at the iterate on the free degrees of freedom [J].
	double workOn(const Eigen::VectorXd& step) const
	{
		if (!std::isfinite(iterate_.balance.size)) return -std::numeric_limits<double>::infinity();
		return linear_.product(step, iterate_.balance.residual);
	}

	bool mayGoOn() const { return !watchdog_.wasVain() && std::isfinite(iterate_.balance.size) && solves_ + 1 < settings_.maxIterations; }
	bool goBack()
	{
		watchdog_.giveUp();
		return search(watchdog_.first);
	}

	bool search(const NewtonStep& step)
	{
		const Shortened best = lineSearch(step, settings_.lineSearchTrials, [&](double part) {
			iterate_.evaluate(step.from + part * step.step, false);
			return workOn(step.step);
		});
		report_.lineSearchTrials += best.trials;
		d_ = step.from + best.length * step.step;
		iterate_.evaluate(d_, true);
		const double length = best.length * step.length;
		if (iterate_.balance.size < step.sizeBefore || length <= system_.model.grid.cellSize) return true;
		report_.residuals.push_back(convergenceTest_.relative(solves_));
		return !fail(report_, Failure::diverging, causeOfDivergence(length));
	}

	const StepSystem<Dim>& system_;
	StepReport&            report_;
	LinearStep<Dim>        linear_;
	const NewtonSettings&  settings_ = system_.model.newton;
	Iterate<Dim>           iterate_ { system_, report_ };
	ConvergenceTest<Dim>   convergenceTest_ { system_, iterate_, report_ };
	Watchdog               watchdog_;
	Eigen::VectorXd        d_         = Eigen::VectorXd::Zero(system_.map.size());
	int                    solves_    = 0;
	bool                   predicted_ = false;
};

} // namespace

template <int Dim> NewtonResult newton(const StepSystem<Dim>& system, LinearSolver& solver, StepReport& report, const Eigen::VectorXd& prediction)
{
	return Newton<Dim>(system, solver, report).run(prediction);
}

template NewtonResult newton(const StepSystem<2>&, LinearSolver&, StepReport&, const Eigen::VectorXd&);
template NewtonResult newton(const StepSystem<3>&, LinearSolver&, StepReport&, const Eigen::VectorXd&);

} // namespace gimpm
