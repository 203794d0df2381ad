// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/solvers/node_solver.hpp"
#include "core/base/stopwatch.hpp"
#include "core/solvers/blas_threads.hpp"
#include "core/solvers/solver_limits.hpp"
#include <algorithm>
#include <cmath>

namespace gimpm {
namespace {

/// A body in which the diagonal has failed stays as it is, though its nodes change: so many times it is not tried
/// again.
constexpr int memory = 8;

} // namespace

struct NodeSolver::Task {
	const NodeProblem&                       problem;
	std::shared_ptr<const SymmetricOperator> K;
	ConjugateGradients                       iteration;
	double                                   tolerance;
	SolverTimes&                             times;
	IterativeEffort&                         effort;
	std::string                              failure {}; ///< message of multigrid

	bool iterate(int atMost)
	{
		const Stopwatch watch(times.solve);
		const int       before  = iteration.made();
		const bool      hasDone = iteration.iterate(atMost);
		effort.iterations += iteration.made() - before;
		return hasDone;
	}
};

std::string NodeSolver::solve(
        const NodeProblem& problem, const Eigen::VectorXd& b, double tolerance, LinearMethod method, Eigen::VectorXd& x, SolverTimes& times,
        IterativeEffort& effort)
{
	const OneBlasThread                      guard;
	std::shared_ptr<const SymmetricOperator> K;
	Eigen::VectorXd                          all;
	{
		const Stopwatch watch(times.solve);
		K   = problem.blocks();
		all = problem.expanded(b);
	}
	Task task { problem, K, ConjugateGradients(*K, all, tolerance), tolerance, times, effort };
	iterate(task, method);
	const std::string failure = task.iteration.take(all);
	x                         = problem.ofFreeDofs(all);
	if (!task.failure.empty()) effort.reason = "multigrid: " + task.failure;
	return failure;
}

void NodeSolver::iterate(Task& task, LinearMethod method)
{
	if (multigrid_ && (method == LinearMethod::iterative || !multigrid_->fits(task.problem))) multigrid_.reset();
	if (task.iterate(0)) return; // there is nothing to do, or it cannot be done
	if (method != LinearMethod::iterative) {
		const bool isTried = method == LinearMethod::automatic && !multigrid_ && untried_ == 0;
		if (isTried && iterateWithDiagonal(task)) return;
		if (iterateWithMultigrid(task)) {
			if (isTried) untried_ = memory;
			return;
		}
		task.iteration.precondition(nullptr);
		multigrid_.reset();
	}
	task.iterate(mostIterations - task.iteration.made());
}

/// False if multigrid will be faster. The residual of a slender body that bends grows first, that of others has fallen
/// to less than a tenth by then.
bool NodeSolver::iterateWithDiagonal(Task& task)
{
	const double first = task.iteration.error();
	if (task.iterate(firstTrial)) return true;
	return task.iteration.error() < first && task.iterate(patience - firstTrial);
}

/// False, and the task says why, if it cannot be set up or breaks down.
bool NodeSolver::iterateWithMultigrid(Task& task)
{
	ConjugateGradients& iteration = task.iteration;
	if (multigrid_) {
		iteration.precondition(multigrid_.get());
		const double expected = perDecade_ * std::log10(iteration.error() / task.tolerance);
		const int    before   = iteration.made();
		task.iterate(few + int(tooMany * expected));
		if (iteration.hasConverged()) {
			if (iteration.made() - before > few + worthRenewing * expected) untried_ = std::max(untried_, 1), multigrid_.reset();
			return true;
		}
		iteration.precondition(nullptr); // it was of an earlier matrix
		if (task.iterate(0)) return true;
	}
	if (!setUp(task)) return false;
	iteration.precondition(multigrid_.get());
	const double error  = iteration.error();
	const int    before = iteration.made();
	task.iterate(mostWithMultigrid);
	perDecade_   = (iteration.made() - before) / std::max(std::log10(error / iteration.error()), 1e-3);
	task.failure = iteration.fault();
	if (!task.iterate(0)) task.failure = "no convergence in " + std::to_string(mostWithMultigrid) + " iterations";
	return task.failure.empty();
}

bool NodeSolver::setUp(Task& task)
{
	const Stopwatch watch(task.times.factorise);
	multigrid_.reset();
	multigrid_ = Multigrid::of(task.problem, task.K, task.failure);
	if (!multigrid_) return false;
	++task.effort.hierarchies;
	untried_ = std::max(untried_ - 1, 0);
	return true;
}

} // namespace gimpm
