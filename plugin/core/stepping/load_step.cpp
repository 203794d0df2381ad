// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/load_step.hpp"
#include "core/base/stopwatch.hpp"
#include "core/parallel/halo.hpp"
#include "core/stepping/acceptance.hpp"
#include "core/stepping/lost_constraint.hpp"
#include "core/stepping/newton.hpp"
#include "core/stepping/outcome.hpp"
#include "core/stepping/rate_change.hpp"
#include "core/stepping/restraint.hpp"
#include "core/stepping/step_control.hpp"
#include "core/stepping/wall_overhang.hpp"
#include "core/terms/inertia/inertia.hpp"
#include <utility>

namespace gimpm {
namespace {

/// Fixes loose points where they are: no equilibrium determines where they go.
template <int Dim> void keepStill(const LoosePoints& loose, StepSystem<Dim>& system, StepReport& report)
{
	report.loosePoints   = loose.points;
	report.loosePosition = loose.position;
	if (loose.points == 0) return;
	system.fixNodes(loose.nodes);
	report.dofs = system.dofs.count;
}

/// True if the body can neither move freely nor has lost the boundaries that push it. The report says so if not.
template <int Dim> bool isConstrained(StepSystem<Dim>& system, StepReport& report)
{
	const Stopwatch   watch(report.times.basis);
	const auto&       model = system.model;
	const std::string lost  = system.hasInertia() ? "" : lostConstraint(system.cloud, system.basis, model, system.load);
	const Restraint   held  = restraint(system.basis, model.grid, model.boundary, system.terms, *model.division);
	report.parts            = held.parts;
	keepStill(held.loose, system, report);
	if (const std::string between = boxBetweenNodes(system.basis, model.boundary); !between.empty()) return !fail(report, Failure::misplaced, between);
	if (!lost.empty()) return !fail(report, Failure::detached, lost);
	if (isObstructed(system, report)) return false;
	return held.freeMotion.empty() || !fail(report, Failure::unrestrained, "nothing restrains the " + held.freeMotion);
}

/// Growth of several fields as expected from their rates: flow goes on where no load grows.
template <int Dim> Eigen::VectorXd expectedOfFields(const StepSystem<Dim>& system)
{
	const auto expected = system.expected();
	if (!expected || int(expected->values.size()) != system.map.fields()) return {};
	auto d = system.map.zeros();
	for (int f = 0; f < system.map.fields(); ++f)
		d[f] = continued(expected->nodes, expected->values[f], 1, system.map[f].width, system.basis.nodes, system.model.grid);
	return system.map.joined(d);
}

/// Start of Newton's method from the step before, empty if that tells nothing.
template <int Dim> Eigen::VectorXd predictionFor(const StepSystem<Dim>& system, const LastIncrement<Dim>* last)
{
	if (!last || system.hasInertia()) return {};
	Eigen::VectorXd d = system.map.isAlone() ? predict(*last, system.basis.nodes, system.load.growth(), system.model.grid) : expectedOfFields(system);
	if (d.size() > 0) system.constraints.template distribute<Dim>(system.map, d);
	return d;
}

/// Newton's method from the prediction, if there is one (not empty); should it fail from there, it begins again at
/// zero. The solution is the same to the tolerance.
template <int Dim> Eigen::VectorXd solve(const StepSystem<Dim>& system, LinearSolver& solver, StepReport& report, const Eigen::VectorXd& prediction)
{
	StepReport      attempt = report;
	Eigen::VectorXd growth  = newton(system, solver, attempt, prediction);
	if (attempt.predicted && !attempt.converged() && attempt.failure != Failure::interrupted) {
		report.takeEffort(attempt);
		return newton(system, solver, report, {});
	}
	report = std::move(attempt);
	return growth;
}

/// Points that are loose but for a corner or an edge by which they hang on the rest leave a matrix that is singular, or
/// nearly so. They are looked for where a step fails by it, and stay where they are, as others that are loose do.
template <int Dim> Eigen::VectorXd solveWithoutHinged(StepSystem<Dim>& system, LinearSolver& solver, StepReport& report, const Eigen::VectorXd& prediction)
{
	const StepReport before = report;
	Eigen::VectorXd  growth = solve(system, solver, report, prediction);
	if (report.converged() || !canBeCut(report.failure) || system.hasInertia()) return growth;
	const Model<Dim>& model = system.model;
	const LoosePoints loose = hinged(system.basis, model.grid, model.boundary, system.terms, *model.division);
	if (loose.points <= before.loosePoints) return growth;
	const StepReport attempt = std::exchange(report, before);
	report.takeEffort(attempt);
	keepStill(loose, system, report);
	return solve(system, solver, report, prediction);
}

/// Solves for equilibrium, and goes on from there as long as the stabilisation takes up more of the work than it may,
/// by the proximal point method. Where no stress can bear the load the body moves on by the same in each pass, and the
/// ratio of work does not fall.
template <int Dim> Eigen::VectorXd equilibrium(StepSystem<Dim>& system, LinearSolver& solver, StepReport& report, const Eigen::VectorXd& prediction)
{
	constexpr int    few       = 10;
	constexpr double falling   = 0.8; // in so many passes
	Eigen::VectorXd  growth    = solveWithoutHinged(system, solver, report, prediction);
	const bool       predicted = report.predicted;
	for (double before = std::numeric_limits<double>::infinity(); report.converged() && report.ghostShare > system.model.ghost.workTolerance;
	     ++report.passes) {
		if (report.passes % few == 0) {
			if (report.ghostShare > falling * before) {
				fail(report, Failure::stabilised, causeOfStabilised(report, system.model.ghost.workTolerance));
				break;
			}
			before = report.ghostShare;
		}
		system.ghostReference = growth;
		growth                = solve(system, solver, report, growth);
		report.predicted      = predicted;
	}
	return growth;
}

/// Reviews a solution: a converged step may have ended where a term does not admit it, or with an error above its
/// tolerance. One that has not may be due to contact which no longer holds the body. The report says so.
template <int Dim>
void review(const StepSystem<Dim>& system, const Eigen::VectorXd& growth, const LastIncrement<Dim>* last, const Eigen::VectorXd& prediction, StepReport& report)
{
	const Model<Dim>&     model = system.model;
	const Eigen::VectorXd d     = system.map.displacements(growth);
	if (!model.terms.empty() || system.hasInertia() || system.isCoupled()) {
		if (report.converged()) askForRefusals(system, d, report);
		else if (report.failure == Failure::singular || canBeCut(report.failure)) {
			const Restraint held = restraintAt(d, system.basis, model.grid, model.boundary, system.terms, *model.division);
			if (!held.freeMotion.empty())
				fail(report, Failure::slides,
				     "only contact, which slips or comes off there, would hold the " + held.freeMotion + " (" + report.cause + ")");
		}
	}
	if (!std::isfinite(model.newton.stepTolerance)) return;
	if (report.converged() && prediction.size() > 0 && system.map.isAlone()) {
		const Stopwatch watch(report.times.update);
		testError(rateChange(system, *last, system.load.growth(), prediction, d), report);
	}
	if (report.converged()) testFieldErrors(system, growth, report);
}

/// Increment of the nodes that are not tied.
template <int Dim> LastIncrement<Dim> incrementOf(const StepSystem<Dim>& system, const Eigen::VectorXd& growth)
{
	const Eigen::VectorXd d = system.map.displacements(growth);
	if (system.basis.affineConstraints.empty()) return { system.basis.nodes, d, system.load.growth() };
	LastIncrement<Dim> last { {}, Eigen::VectorXd(d.size()), system.load.growth() };
	for (int n = 0; n < int(system.basis.nodes.size()); ++n) {
		if (system.basis.affineConstraints.contains(n)) continue;
		last.displacement.template segment<Dim>(Dim * last.nodes.size()) = d.template segment<Dim>(Dim * n);
		last.nodes.push_back(system.basis.nodes[n]);
	}
	last.displacement.conservativeResize(Dim * last.nodes.size());
	return last;
}

} // namespace

/// Steps of the method (Coombs 2023, section 2), for points p, nodes v and growth d at the nodes:
///
///     1. S_vp, grad S_vp at the points; faces of boundary cells and their K_g (eq. 2, terms/ghost.hpp)
///     2. f_ext = sum_p S_vp (m_p g + f_p)
///     3. r(d) = f_ext - sum_p grad S_vp sigma_p(d) V_p(d) - K_g d - other terms, at the nodes of populated cells
///     4. r(d) = 0 by Newton's method (newton.cpp)
///     5. x_p += sum_v S_vp d_v, F_p = (1 + sum_v d_v grad S_vp) F_p, elastic strain, stress and domain of p
///     6. the next step begins with the grid as it was
template <int Dim> StepReport loadStep(PointCloud<Dim>& cloud, const Model<Dim>& model, const Load<Dim>& load, LinearSolver& solver, LastIncrement<Dim>* last)
{
	StepReport report;
	solver.resetTimes();
	const Halo halo(cloud, *model.division, [&] { return pointsForOthers(cloud, model); });
	// 1. to 3. basis functions, populated cells and ghost faces; points to nodes; equations of the populated nodes
	StepSystem<Dim> system(cloud, model, load, report);
	if (!isConstrained(system, report)) return report;
	// 4. displacements of the nodes, and growth of other fields, that satisfy the equations
	const Eigen::VectorXd prediction = predictionFor(system, last);
	if (model.ghost.memory > 0 && prediction.size() > 0) system.ghostReference = model.ghost.memory * prediction;
	const Eigen::VectorXd growth = equilibrium(system, solver, report, prediction);
	review(system, growth, last, prediction, report);
	report.times.linear       = solver.times();
	report.conjugateGradients = solver.iterativeEffort();
	report.accepted           = report.failure == Failure::tooManyIterations && model.newton.acceptUnconverged;
	// 5. nodes to points; 6. the grid is reset by not being kept
	if ((report.converged() || report.accepted) && accept(system, cloud, growth, report)) {
		if (system.inertia) addInertiaBeyondWalls(system, system.inertia->motion(), report);
		if (last) *last = incrementOf(system, growth);
	}
	return report;
}

template <int Dim> LinearProblem tangentStiffness(const PointCloud<Dim>& cloud, const Model<Dim>& model, StepReport* told)
{
	StepReport            own, &report = told ? *told : own;
	const StepSystem<Dim> system(cloud, model, Load<Dim>(), report);
	NodeMatrix<Dim>       K;
	Couplings             couplingBlocks;
	return tangent(system, K, couplingBlocks, report) ? reduced(K, system.dofs, system.isCoupled() ? &couplingBlocks : nullptr)
	                                                  : LinearProblem(SymmetricCsc { { { 0 }, {}, {} } });
}

template StepReport    loadStep(PointCloud<2>&, const Model<2>&, const Load<2>&, LinearSolver&, LastIncrement<2>*);
template StepReport    loadStep(PointCloud<3>&, const Model<3>&, const Load<3>&, LinearSolver&, LastIncrement<3>*);
template LinearProblem tangentStiffness(const PointCloud<2>&, const Model<2>&, StepReport*);
template LinearProblem tangentStiffness(const PointCloud<3>&, const Model<3>&, StepReport*);

} // namespace gimpm
