// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/equilibrium.hpp"
#include "core/stepping/newton.hpp"

namespace gimpm {

template <int Dim> Eigen::VectorXd equilibrium(const StepSystem<Dim>& system, LinearSolver& solver, StepReport& report, const Eigen::VectorXd& prediction)
{
	if (prediction.size() > 0) {
		StepReport   attempt = report;
		NewtonResult result  = newton(system, solver, attempt, prediction);
		if (attempt.converged() || attempt.failure == Failure::interrupted || !result.predicted) {
			attempt.predicted = result.predicted;
			report            = std::move(attempt);
			return result.growth;
		}
		report.takeEffort(attempt);
	}
	return newton(system, solver, report, {}).growth;
}

template Eigen::VectorXd equilibrium(const StepSystem<2>&, LinearSolver&, StepReport&, const Eigen::VectorXd&);
template Eigen::VectorXd equilibrium(const StepSystem<3>&, LinearSolver&, StepReport&, const Eigen::VectorXd&);

} // namespace gimpm
