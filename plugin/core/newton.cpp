// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/newton.hpp"
#include "core/stopwatch.hpp"
#include <sstream>

namespace gimpm {
namespace {

/// Out-of-balance forces on the free degrees of freedom, and their size relative to external forces and reactions.
struct Balance {
	Eigen::VectorXd residual; // by number of the free degree of freedom
	double          relative; // |residual| / |external forces + reactions|
	int             worst = -1; // nodal degree of freedom
};

Balance balance(const FreeDofs& dofs, const Eigen::VectorXd& external, const Eigen::VectorXd& force)
{
	Balance b { Eigen::VectorXd(dofs.count), 0 };
	// scaled, so that forces as small as 1e-200 N do not vanish when they are squared
	const double scale     = std::max({ external.lpNorm<Eigen::Infinity>(), force.lpNorm<Eigen::Infinity>(), std::numeric_limits<double>::min() });
	double       imbalance = 0, reference = 0, largest = -1;
	for (int i = 0; i < int(dofs.number.size()); ++i) {
		const int n = dofs.number[i];
		if (n < 0) {
			reference += std::pow(force[i] / scale, 2); // external force + reaction = internal force
			continue;
		}
		const double r = b.residual[n] = external[i] - force[i];
		imbalance += std::pow(r / scale, 2);
		reference += std::pow(external[i] / scale, 2);
		if (std::abs(r) > largest) largest = std::abs(r), b.worst = i;
	}
	b.relative = imbalance == 0 ? 0 : std::sqrt(imbalance / reference); // without any load: converged, not 0/0
	return b;
}

template <int Dim> void reportWorst(const StepSystem<Dim>& system, const Balance& b, StepReport& report)
{
	if (b.worst < 0) return;
	report.worst.position.setZero();
	report.worst.position.head<Dim>() = system.model.grid.nodePosition(Grid<Dim>::index(system.basis.nodes[b.worst / Dim]));
	report.worst.axis                 = b.worst % Dim;
	report.worst.force                = b.residual[system.dofs.number[b.worst]];
}

void fail(StepReport& report, Failure failure, const std::string& cause)
{
	report.failure = failure;
	report.cause   = cause;
}

/// One solve: d += K^-1 (residual - K_fc prescribed), with the prescribed displacements themselves. False if K is singular.
template <int Dim>
bool correct(const StepSystem<Dim>& system, const NodeMatrix<Dim>& K, const Eigen::VectorXd& prescribed, const Balance& b, LinearSolver& solver, Eigen::VectorXd& d, StepReport& report)
{
	Eigen::VectorXd right = b.residual, correction;
	if (prescribed.size() > 0) {
		Eigen::VectorXd held = Eigen::VectorXd::Zero(system.nodalSize());
		K.multiplyAdd(prescribed, held);
		for (int i = 0; i < held.size(); ++i)
			if (system.dofs.number[i] >= 0) right[system.dofs.number[i]] -= held[i];
		d += prescribed;
	}
	if (system.dofs.count > 0) {
		SymmetricCsc reduced;
		reduce(K, system.dofs, reduced);
		const auto status = solver.solve(reduced, right, correction);
		if (status == LinearSolver::Status::singular) return false;
		report.luSolves += status == LinearSolver::Status::lu;
		for (int i = 0; i < d.size(); ++i)
			if (system.dofs.number[i] >= 0) d[i] += correction[system.dofs.number[i]];
	}
	return true;
}

} // namespace

template <int Dim> Eigen::VectorXd equilibrium(const StepSystem<Dim>& system, LinearSolver& solver, StepReport& report)
{
	const auto&     newton     = system.model.newton;
	Eigen::VectorXd d          = Eigen::VectorXd::Zero(system.nodalSize()), force;
	Eigen::VectorXd prescribed = system.prescribed.any() ? system.prescribed : Eigen::VectorXd();
	NodeMatrix<Dim> K;
	system.prepare(K);
	while (true) {
		InvertedPoint inverted;
		{
			const Stopwatch watch(report.times.assembly);
			inverted = system.evaluate(d, force, &K);
		}
		if (inverted >= 0) {
			report.invertedPoint = inverted;
			fail(report, Failure::inverted, "a material point was turned inside out (det F <= 0)");
			break;
		}
		const Balance b = balance(system.dofs, system.external, force);
		report.residuals.push_back(b.relative);
		reportWorst(system, b, report);
		if (!std::isfinite(b.relative)) {
			fail(report, Failure::notFinite, "the residual is not finite");
			break;
		}
		// At least one solve: a load increment below the tolerance must not be lost.
		if ((report.iterations > 0 && b.relative <= newton.tolerance) || (b.relative == 0 && prescribed.size() == 0)) break;
		if (report.iterations == newton.maxIterations) {
			std::ostringstream text;
			text << "the residual " << b.relative << " is above the tolerance " << newton.tolerance << " after " << report.iterations << " iterations";
			fail(report, Failure::tooManyIterations, text.str());
			break;
		}
		if (!correct(system, K, prescribed, b, solver, d, report)) {
			fail(report, Failure::singular, "the stiffness matrix is singular to working precision");
			break;
		}
		prescribed.resize(0);
		++report.iterations;
	}
	return d;
}

template Eigen::VectorXd equilibrium(const StepSystem<2>&, LinearSolver&, StepReport&);
template Eigen::VectorXd equilibrium(const StepSystem<3>&, LinearSolver&, StepReport&);

} // namespace gimpm
