// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/linear_step.hpp"
#include "core/base/stopwatch.hpp"

namespace gimpm {

/// Calls f for the unknowns that are solved for, the residuals of which are multiplied by the scale.
template <int Dim> template <class F> void LinearStep<Dim>::forFree(F&& f) const
{
	const DofMap& map = system_.map;
	for (int field = 0; field < map.fields(); ++field)
		for (int i = map.begin(field); i < map.end(field); ++i)
			if (system_.dofs.number[i] >= 0) f(i, system_.dofs.number[i], map[field].scale);
}

template <int Dim> bool LinearStep<Dim>::solve(const Residual<Dim>& at, const Eigen::VectorXd& caused, double forcing, Eigen::VectorXd& step)
{
	if (system_.dofs.count == 0) return true;
	const Couplings* couplings = system_.isCoupled() ? &at.couplingBlocks : nullptr;
	Eigen::VectorXd  right     = at.values;
	if (caused.size() > 0) forFree([&](int i, int number, double scale) { right[number] -= scale * caused[i]; });
	const LinearProblem problem = [&] {
		const Stopwatch watch(report_.times.assembly);
		return system_.dofs.affineConstraints ? reduced(at.K, system_.dofs, couplings)
		                                      : LinearProblem(at.K, system_.dofs, system_.ownedNodes(), couplings);
	}();
	if (!solver_.staysOverNodes(method_, problem)) {
		const Stopwatch watch(report_.times.assembly);
		problem.stored();
	}
	using Status = LinearSolver::Status;
	isOld_       = false;
	solver_.kept.discard();
	Eigen::VectorXd correction;
	hasSigns_               = couplings && problem.isSymmetric();
	const bool   isDefinite = problem.isSymmetric() && !problem.hasSigns();
	const Status status     = solver_.solve(problem, withSigns(std::move(right)), correction, method_, forcing);
	keepsFactor_            = status == (isDefinite ? Status::cholesky : Status::lu);
	if (status != Status::iterative) {
		method_ = LinearMethod::direct; // systems that could not be solved iteratively once stay difficult
		if (isDefinite) report_.definiteness = keepsFactor_ ? Definiteness::positive : Definiteness::indefinite;
	}
	if (keepsFactor_ && system_.model.newton.keepFactor > 0) solver_.kept.renew(unknowns(), hasSigns_);
	if (status == Status::singular) return false;
	report_.luSolves += status == Status::lu;
	addTo(step, correction);
	return true;
}

template <int Dim> KeptFactor::Unknowns LinearStep<Dim>::unknowns() const
{
	KeptFactor::Unknowns those { system_.dofs.number, {} };
	for (int field = 0; field < system_.map.fields(); ++field)
		those.scales.push_back(system_.map[field].scale);
	return those;
}

template <int Dim> bool LinearStep<Dim>::takesOver(bool isComplete)
{
	if (system_.model.newton.keepFactor == 0) return false;
	std::int64_t isOffered = solver_.kept.isOffered(unknowns()) && isComplete;
	system_.ownedNodes().processes.smallest(&isOffered, 1);
	hasSigns_     = solver_.kept.hasSigns();
	return isOld_ = keepsFactor_ = isOffered;
}

template <int Dim> void LinearStep<Dim>::noteReduction(double part)
{
	if (isOld_ && again_++ == 0) solver_.kept.note(part);
}

template <int Dim> void LinearStep<Dim>::hasConverged()
{
	if (isOld_) solver_.kept.hasServed();
}

template <int Dim> void LinearStep<Dim>::dropFactor()
{
	if (isOld_) solver_.kept.hasFailed();
	isOld_ = keepsFactor_ = false;
}

template <int Dim> bool LinearStep<Dim>::solveAgain(const Eigen::VectorXd& residual, Eigen::VectorXd& step)
{
	Eigen::VectorXd correction;
	if (!solver_.solveAgain(withSigns(residual), correction)) return false;
	addTo(step, correction);
	return true;
}

/// Residual with the signs of the matrix's rows.
template <int Dim> Eigen::VectorXd LinearStep<Dim>::withSigns(Eigen::VectorXd residual) const
{
	const DofMap& map = system_.map;
	for (int field = 0; hasSigns_ && field < map.fields(); ++field)
		for (int i = map.begin(field); map[field].sign < 0 && i < map.end(field); ++i)
			if (const int number = system_.dofs.number[i]; number >= 0) residual[number] *= -1;
	return residual;
}

template <int Dim> double LinearStep<Dim>::work(const Eigen::VectorXd& step, const Eigen::VectorXd& force) const
{
	double sum = 0;
	forFree([&](int i, int number, double scale) { sum += step[i] / scale * force[number]; });
	return sum;
}

template <int Dim> void LinearStep<Dim>::addTo(Eigen::VectorXd& step, const Eigen::VectorXd& correction) const
{
	forFree([&](int i, int number, double scale) { step[i] += scale * correction[number]; });
	system_.constraints.template distribute<Dim>(system_.map, step);
}

template class LinearStep<2>;
template class LinearStep<3>;

} // namespace gimpm
