// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/load_step.hpp"
#include "core/base/stopwatch.hpp"
#include "core/parallel/halo.hpp"
#include "core/stepping/acceptance.hpp"
#include "core/stepping/equilibrium.hpp"
#include "core/stepping/lost_constraint.hpp"
#include "core/stepping/outcome.hpp"
#include "core/stepping/rate_change.hpp"
#include "core/stepping/restraint.hpp"
#include "core/stepping/step_control.hpp"
#include "core/stepping/wall_overhang.hpp"
#include "core/terms/inertia/inertia.hpp"
#include <utility>

namespace gimpm {
namespace {

/// Points that are loose stay where they are: no equilibrium determines where they go.
template <int Dim> void keepStill(const LoosePoints& loose, StepSystem<Dim>& system, const Load<Dim>& load, StepReport& report)
{
	report.loosePoints   = loose.points;
	report.loosePosition = loose.position;
	if (loose.points == 0) return;
	system.fixNodes(loose.nodes, load);
	report.dofs = system.dofs.count;
}

/// True if the body can neither move freely nor has lost the boundaries that push it. The report says so if not.
template <int Dim> bool isConstrained(StepSystem<Dim>& system, const PointCloud<Dim>& cloud, const Load<Dim>& load, StepReport& report)
{
	const Stopwatch   watch(report.times.basis);
	const std::string lost = system.hasInertia() ? "" : lostConstraint(cloud, system.basis, system.model, load);
	const Restraint   held = restraint(system.basis, system.model.grid, system.model.boundary, system.terms, *system.model.division);
	report.parts           = held.parts;
	keepStill(held.loose, system, load, report);
	if (const std::string between = boxBetweenNodes(system.basis, system.model.boundary); !between.empty())
		return !fail(report, Failure::misplaced, between);
	if (!lost.empty()) return !fail(report, Failure::detached, lost);
	if (isObstructed(system, report)) return false;
	return held.freeMotion.empty() || !fail(report, Failure::unrestrained, "nothing restrains the " + held.freeMotion);
}

/// A converged step may have ended where a term does not admit it. One that has not may be due to contact which no
/// longer holds the body: says so.
template <int Dim> void explain(const StepSystem<Dim>& system, const Eigen::VectorXd& d, StepReport& report)
{
	if (report.converged()) return askForRefusals(system, d, report);
	if (report.failure != Failure::singular && !canBeCut(report.failure)) return;
	const Restraint held = restraintAt(d, system.basis, system.model.grid, system.model.boundary, system.terms, *system.model.division);
	if (!held.freeMotion.empty())
		fail(report, Failure::slides, "only contact, which slips or comes off there, would hold the " + held.freeMotion + " (" + report.cause + ")");
}

/// Expected growth of several fields, by their rates: flow goes on where no load grows.
template <int Dim> Eigen::VectorXd expectedOfFields(const StepSystem<Dim>& system)
{
	const auto expected = system.expected();
	if (!expected || int(expected->values.size()) != system.map.fields()) return {};
	auto d = system.map.zeros();
	for (int f = 0; f < system.map.fields(); ++f)
		d[f] = continued(expected->nodes, expected->values[f], 1, system.map[f].width, system.basis.nodes, system.model.grid);
	return system.map.joined(d);
}

template <int Dim> Eigen::VectorXd predictionFor(const StepSystem<Dim>& system, const LastIncrement<Dim>& last, double growth)
{
	Eigen::VectorXd d = system.map.isAlone() ? predict(last, system.basis.nodes, growth, system.model.grid) : expectedOfFields(system);
	if (d.size() > 0) system.constraints.template distribute<Dim>(system.map, d);
	return d;
}

/// Points that are loose but for a corner or an edge by which they hang on the rest leave a matrix that is singular, or
/// nearly so. They are looked for where a step fails by it, and stay where they are, as others that are loose do.
template <int Dim>
Eigen::VectorXd equilibriumOfHeld(StepSystem<Dim>& system, LinearSolver& solver, StepReport& report, const Eigen::VectorXd& prediction, const Load<Dim>& load)
{
	const StepReport before = report;
	Eigen::VectorXd  growth = equilibrium(system, solver, report, prediction);
	if (report.converged() || !canBeCut(report.failure) || system.hasInertia()) return growth;
	const Model<Dim>& model = system.model;
	const LoosePoints loose = hinged(system.basis, model.grid, model.boundary, system.terms, *model.division);
	if (loose.points <= before.loosePoints) return growth;
	const StepReport attempt = std::exchange(report, before);
	report.takeEffort(attempt);
	keepStill(loose, system, load, report);
	return equilibrium(system, solver, report, prediction);
}

/// Goes on from d as long as the stabilisation takes up more of the work than it may, by the proximal point method.
/// Where no stress can bear the load the body moves on by the same in each pass, and the share does not fall.
template <int Dim> Eigen::VectorXd relieved(StepSystem<Dim>& system, LinearSolver& solver, StepReport& report, Eigen::VectorXd growth)
{
	constexpr int    few       = 10;
	constexpr double falling   = 0.8; // in so many passes
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
		growth                = equilibrium(system, solver, report, growth);
		report.predicted      = predicted;
	}
	return growth;
}

/// Increment of the nodes that are not tied.
template <int Dim> LastIncrement<Dim> incrementOf(const StepSystem<Dim>& system, const Eigen::VectorXd& d, double growth)
{
	if (system.basis.affineConstraints.empty()) return { system.basis.nodes, d, growth };
	LastIncrement<Dim> last { {}, Eigen::VectorXd(d.size()), growth };
	for (int n = 0; n < int(system.basis.nodes.size()); ++n) {
		if (system.basis.affineConstraints.contains(n)) continue;
		last.displacement.template segment<Dim>(Dim * last.nodes.size()) = d.template segment<Dim>(Dim * n);
		last.nodes.push_back(system.basis.nodes[n]);
	}
	last.displacement.conservativeResize(Dim * last.nodes.size());
	return last;
}

} // namespace

template <int Dim> StepReport loadStep(PointCloud<Dim>& cloud, const Model<Dim>& model, const Load<Dim>& load, LinearSolver& solver, LastIncrement<Dim>* last)
{
	StepReport report;
	solver.resetTimes();
	const Halo halo(cloud, *model.division, [&] { return pointsForOthers(cloud, model); });
	// 1. basis functions and populated cells; boundary cells, ghost faces and K_g
	StepSystem<Dim> system(cloud, model, load, report);
	if (!isConstrained(system, cloud, load, report)) return report;
	// 2. to 4. points to nodes, assembly and Newton's method on the nodes
	const bool            predicts   = last && !system.hasInertia();
	const Eigen::VectorXd prediction = predicts ? predictionFor(system, *last, load.growth()) : Eigen::VectorXd();
	if (model.ghost.memory > 0 && prediction.size() > 0) system.ghostReference = model.ghost.memory * prediction;
	const Eigen::VectorXd growth = relieved(system, solver, report, equilibriumOfHeld(system, solver, report, prediction, load));
	const Eigen::VectorXd d      = system.map.displacements(growth);
	if (!model.terms.empty() || system.hasInertia() || system.isCoupled()) explain(system, d, report);
	if (report.converged() && prediction.size() > 0 && system.map.isAlone() && std::isfinite(model.newton.stepTolerance)) {
		const Stopwatch watch(report.times.update);
		testError(rateChange(system, *last, load.growth(), prediction, d), report);
	}
	if (report.converged() && std::isfinite(model.newton.stepTolerance)) judgeFields(system, growth, report);
	report.times.linear       = solver.times();
	report.conjugateGradients = solver.iterativeEffort();
	// 5. nodes to points; 6. the grid is reset by not being kept
	report.accepted = report.failure == Failure::tooManyIterations && model.newton.acceptUnconverged;
	if ((report.converged() || report.accepted) && accept(system, cloud, load, growth, report)) {
		if (system.inertia) addInertiaBeyondWalls(system, system.inertia->motion(), report);
		if (last) *last = incrementOf(system, d, load.growth());
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
