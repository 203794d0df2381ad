// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/outcome.hpp"
#include "core/base/sentence.hpp"
#include "core/terms/inertia/inertia.hpp"

namespace gimpm {

bool fail(StepReport& report, Failure failure, const std::string& cause)
{
	report.failure = failure;
	report.cause   = cause;
	report.advice.clear();
	return true;
}

bool fail(StepReport& report, const PointFailure& failure)
{
	report.failedPoint = failure.point;
	if (failure.reason == PointFailure::Reason::noResponse)
		return fail(report, Failure::noResponse, "the law of a material point has no stress for its strain");
	return fail(report, Failure::inverted, "a material point was turned inside out (det F <= 0)");
}

std::string causeOfStall(double residual, double attained, double tolerance)
{
	const double attainable = std::pow(10, std::ceil(std::log10(2 * attained)));
	return sentence(
	        "the residual stays at ", residual, ", which is round-off here, above the tolerance ", tolerance,
	        "; what can be attained is a tolerance of about ", attainable);
}

std::string causeOfTooMany(const StepReport& report, double tolerance, bool isWholeInBalance, int iterations)
{
	const std::string after = sentence(" after ", iterations, " iterations");
	const std::string where = report.worst.field.empty() ? "" : sentence(", and most of it is of the ", report.worst.field);
	if (!isWholeInBalance) return sentence("the residual ", report.residual(), " is above the tolerance ", tolerance, after, where);
	return sentence(
	        "the residual ", report.residual(), " of the whole is small, but around a node it is still ", report.localResidual,
	        " of the forces there, more than ", localTolerance, " times the tolerance ", tolerance, ",", after);
}

std::string causeOfStabilised(const StepReport& report, double allowed)
{
	return sentence(
	        "the ghost stabilisation still takes up ", report.ghostShare, " of the work at the edge of the body, more than ghost.workTolerance = ", allowed,
	        ", after it was relieved ", report.passes, " times: no stress in the points bears that load");
}

std::string causeOfDivergence(double correction)
{
	return sentence("it diverges: a correction of ", correction, " m, more than a cell, does not reduce the residual");
}

template <int Dim> bool isObstructed(const StepSystem<Dim>& system, StepReport& report)
{
	if (const std::string obstacle = system.obstacle(); !obstacle.empty()) return fail(report, Failure::misplaced, obstacle);
	for (const auto& term : system.terms)
		if (const std::string obstacle = term->obstacle(); !obstacle.empty()) return fail(report, Failure::misplaced, obstacle);
	return system.inertia && system.inertia->isSingular() && fail(report, Failure::singular, "the mass matrix is singular to working precision");
}

template <int Dim> bool tangent(const StepSystem<Dim>& system, NodeMatrix<Dim>& K, Couplings& couplingBlocks, StepReport& report)
{
	if (isObstructed(system, report)) return false;
	Eigen::VectorXd force;
	system.prepare(K, &couplingBlocks);
	const auto failure = system.evaluate(Eigen::VectorXd::Zero(system.map.size()), force, &K, nullptr, &couplingBlocks);
	return !failure || !fail(report, *failure);
}

template <int Dim> void reportWorst(const StepSystem<Dim>& system, const Residual<Dim>& residual, StepReport& report)
{
	if (residual.worst < 0) return;
	report.worst.position.setZero();
	const int field = system.map.fieldOf(residual.worst), inField = residual.worst - system.map.begin(field), width = system.map[field].width;
	report.worst.position.template head<Dim>() = system.model.grid.nodePosition(Grid<Dim>::index(system.basis.nodes[inField / width]));
	report.worst.axis                          = field == 0 ? inField % width : -1;
	report.worst.field                         = field == 0 ? "" : system.map[field].name;
	report.worst.force                         = residual.values[system.dofs.number[residual.worst]] / system.map[field].scale;
}

template <int Dim> std::vector<Vec3> reactions(const StepSystem<Dim>& system, const Eigen::VectorXd& force)
{
	const auto&       boundary = system.model.boundary;
	std::vector<Vec3> sums(boundary.boxes().size(), Vec3::Zero());
	for (int i = 0; i < system.nodalSize(); ++i) {
		if (system.dofs.number[i] >= 0) continue;
		const auto* box = boundary.constrainingBox(system.basis.nodes[i / Dim], i % Dim);
		if (!box) continue; // the node is tied to others, which have taken its force
		sums[box - boundary.boxes().data()][i % Dim] += force[i] - system.external[i];
	}
	return sums;
}

template <int Dim> Vec3 looseForce(const StepSystem<Dim>& system, const Eigen::VectorXd& force)
{
	Vec3 sum = Vec3::Zero();
	for (int i = 0; i < system.nodalSize(); ++i)
		if (system.isStill(i / Dim) && !system.model.boundary.constrainingBox(system.basis.nodes[i / Dim], i % Dim))
			sum[i % Dim] += force[i] - system.external[i];
	return sum;
}

template <int Dim> double ghostWorkRatio(const StepSystem<Dim>& system, const Eigen::VectorXd& d, const Eigen::VectorXd& force)
{
	// Forces of the stabilisation below this part of the largest nodal force from outside are none: where hardly
	// anything moves, as in a step of rest, they may be most of what little work there is.
	constexpr double leastGhostForce = 0.02;
	if (system.hasInertia() || !system.map.isAlone()) return std::numeric_limits<double>::quiet_NaN();
	if (system.model.ghost.factor == 0) return 0;
	const Eigen::VectorXd ofGhost = system.ghostForce(d);
	if (ofGhost.template lpNorm<Eigen::Infinity>() <= leastGhostForce * system.external.template lpNorm<Eigen::Infinity>()) return 0;
	const Eigen::VectorXd ofPoints = force - system.otherForces(d) - ofGhost;
	double                byGhost = 0, byPoints = 0;
	for (Eigen::Index i = 0; i < d.size(); ++i) {
		if (ofGhost[i] == 0) continue; // no face is there
		byGhost += d[i] * ofGhost[i];
		byPoints += std::abs(d[i] * ofPoints[i]);
	}
	return byGhost == 0 ? 0 : std::abs(byGhost) / (std::abs(byGhost) + byPoints);
}

template bool              isObstructed(const StepSystem<2>&, StepReport&);
template bool              isObstructed(const StepSystem<3>&, StepReport&);
template bool              tangent(const StepSystem<2>&, NodeMatrix<2>&, Couplings&, StepReport&);
template bool              tangent(const StepSystem<3>&, NodeMatrix<3>&, Couplings&, StepReport&);
template void              reportWorst(const StepSystem<2>&, const Residual<2>&, StepReport&);
template void              reportWorst(const StepSystem<3>&, const Residual<3>&, StepReport&);
template std::vector<Vec3> reactions(const StepSystem<2>&, const Eigen::VectorXd&);
template std::vector<Vec3> reactions(const StepSystem<3>&, const Eigen::VectorXd&);
template Vec3              looseForce(const StepSystem<2>&, const Eigen::VectorXd&);
template Vec3              looseForce(const StepSystem<3>&, const Eigen::VectorXd&);
template double            ghostWorkRatio(const StepSystem<2>&, const Eigen::VectorXd&, const Eigen::VectorXd&);
template double            ghostWorkRatio(const StepSystem<3>&, const Eigen::VectorXd&, const Eigen::VectorXd&);

} // namespace gimpm
