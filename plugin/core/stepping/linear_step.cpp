// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/linear_step.hpp"
#include "core/base/stopwatch.hpp"

namespace gimpm {

template <int Dim>
LinearStep<Dim>::LinearStep(const StepSystem<Dim>& system, LinearSolver& solver, StepReport& report)
        : system_(system), solver_(solver), report_(report), method_(system.model.newton.linearSolver)
{
	if (system.prescribed.any()) prescribed_ = system.prescribed;
}

template <int Dim> bool LinearStep<Dim>::solve(const NodeMatrix<Dim>& K, Eigen::VectorXd residual, double forcing, Eigen::VectorXd& step)
{
	step = Eigen::VectorXd::Zero(system_.nodalSize());
	if (prescribes()) {
		Eigen::VectorXd held = step;
		K.multiplyAdd(prescribed_, held);
		system_.basis.ties.template fold<Dim>(held);
		if (system_.share()) system_.share()->complete(held);
		for (int i = 0; i < held.size(); ++i)
			if (system_.dofs.number[i] >= 0) residual[system_.dofs.number[i]] -= held[i];
		step = prescribed_;
		hasPrescribed();
	}
	if (system_.dofs.count == 0) return true;
	const LinearProblem problem = system_.basis.ties.empty() ? LinearProblem(K, system_.dofs, system_.share()) : reduced(K, system_.dofs);
	if (!solver_.staysOverNodes(method_, problem)) {
		const Stopwatch watch(report_.times.assembly);
		problem.stored();
	}
	using Status = LinearSolver::Status;
	Eigen::VectorXd correction;
	const Status    status = solver_.solve(problem, residual, correction, method_, forcing);
	keepsFactor_           = status == (problem.isSymmetric() ? Status::cholesky : Status::lu);
	if (status != Status::iterative) {
		method_ = LinearMethod::direct; // what could not be solved iteratively once stays difficult
		if (problem.isSymmetric()) report_.definiteness = keepsFactor_ ? Definiteness::positive : Definiteness::indefinite;
	}
	if (status == Status::singular) return false;
	report_.luSolves += status == Status::lu;
	addTo(step, correction);
	return true;
}

template <int Dim> bool LinearStep<Dim>::solveAgain(const Eigen::VectorXd& residual, Eigen::VectorXd& step)
{
	Eigen::VectorXd correction;
	step = Eigen::VectorXd::Zero(system_.nodalSize());
	if (!solver_.solveAgain(residual, correction)) return false;
	addTo(step, correction);
	return true;
}

template <int Dim> void LinearStep<Dim>::addTo(Eigen::VectorXd& step, const Eigen::VectorXd& correction) const
{
	for (int i = 0; i < step.size(); ++i)
		if (system_.dofs.number[i] >= 0) step[i] += correction[system_.dofs.number[i]];
	system_.basis.ties.template spread<Dim>(step);
}

template class LinearStep<2>;
template class LinearStep<3>;

} // namespace gimpm
