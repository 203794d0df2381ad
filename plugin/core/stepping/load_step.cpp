// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/load_step.hpp"
#include "core/base/stopwatch.hpp"
#include "core/stepping/beyond_walls.hpp"
#include "core/stepping/equilibrium.hpp"
#include "core/stepping/grip.hpp"
#include "core/stepping/outcome.hpp"
#include "core/stepping/restraint.hpp"
#include "core/stepping/step_control.hpp"
#include "core/terms/point_update.hpp"
#include <sstream>

namespace gimpm {
namespace {

/// A domain ends at the axis of symmetry at the latest.
template <int Dim> void keepOffAxis(PointCloud<Dim>& cloud, int p) { cloud.halfSize[p][0] = std::min(cloud.halfSize[p][0], cloud.position[p][0]); }

/// Step 5: the points take over the converged displacements, and their domains follow the stretch along the grid axes.
template <int Dim> void updatePoints(PointCloud<Dim>& cloud, const StepSystem<Dim>& system, const Eigen::VectorXd& d, StepReport& report)
{
	const double      limit = 0.5 * system.model.grid.cellSize;
	std::vector<char> clamped(cloud.size(), 0);
	provideInternals(cloud.internals, system.model.materials, cloud.size());
	forUpdatedPoints(system.basis, system.points, system.model.materials, d, [&](int p, const PointUpdate<Dim>& u) {
		cloud.position[p] += u.displacement;
		cloud.defGrad[p]       = (cloud.defGrad[p] + u.gradient * cloud.defGrad[p]).eval();
		cloud.elasticStrain[p] = u.elasticStrain;
		withLaw(u.law, [&](const auto& law) { storeInternals(law, u.internals, cloud.internals, p); });
		if (!cloud.hoopStretch.empty()) cloud.hoopStretch[p] *= 1 + u.hoop;
		cloud.stress[p].c = u.kirchhoffStress.c / cloud.volumeRatio(p);
		if (system.model.basis == Basis::gimp) {
			const Vec<Dim> size = cloud.halfSize0[p].cwiseProduct(stretchAlongAxes(cloud.defGrad[p]));
			clamped[p]          = (size.array() > limit).any();
			cloud.halfSize[p]   = size.cwiseMin(limit);
			if (!cloud.hoopStretch.empty()) keepOffAxis(cloud, p);
		}
	});
	for (const char c : clamped)
		report.clampedDomains += c;
}

/// Equilibrium may have been found where no state can be: a point that hardly anything held has left the grid, or has become so flat that
/// numbers do not tell its size. The report says so.
template <int Dim> bool requireState(const PointCloud<Dim>& cloud, const Grid<Dim>& grid, StepReport& report)
{
	const double limit = Grid<Dim>::indexLimit * grid.cellSize;
	for (std::size_t p = 0; p < cloud.size(); ++p) {
		const bool isOnGrid = ((cloud.position[p] - grid.origin).array().abs() < limit).all() && cloud.stress[p].c.allFinite();
		if (isOnGrid && cloud.halfSize[p].minCoeff() > 0 && cloud.defGrad[p].determinant() > 0) continue;
		std::ostringstream text;
		text << "a material point was " << (isOnGrid ? "flattened to nothing, at (" : "thrown off the grid, to (") << cloud.position[p].transpose()
		     << ")";
		report.failure  = Failure::diverging;
		report.accepted = false;
		report.cause    = text.str();
		return false;
	}
	return true;
}

/// Whether the body can neither move freely nor has lost the boundaries that push it. The report says so if not.
template <int Dim> bool isHeld(const StepSystem<Dim>& system, const PointCloud<Dim>& cloud, const Load<Dim>& load, StepReport& report)
{
	const Stopwatch   watch(report.times.basis);
	const std::string lost = system.hasInertia() ? "" : lostGrip(cloud, system.basis, system.model, load);
	const Restraint   held = restraint(system.basis, system.model.grid, system.model.boundary, system.terms);
	report.parts           = held.parts;
	if (!lost.empty()) return !fail(report, Failure::detached, lost);
	for (const auto& term : system.terms) {
		if (const std::string obstacle = term->obstacle(); !obstacle.empty()) return !fail(report, Failure::misplaced, obstacle);
		if (term->isSingular()) return !fail(report, Failure::singular, "the mass matrix is singular to working precision");
	}
	return held.freeMotion.empty() || !fail(report, Failure::unrestrained, "nothing restrains the " + held.freeMotion);
}

/// A converged step may have ended where a term does not admit it. One that has not may be due to friction which no longer holds the body: says so.
template <int Dim> void askTerms(const StepSystem<Dim>& system, const Eigen::VectorXd& d, StepReport& report)
{
	if (!report.converged()) {
		if (report.failure != Failure::singular && !canBeCut(report.failure)) return;
		const Restraint held = restraintAt(d, system.basis, system.model.grid, system.model.boundary, system.terms);
		if (!held.freeMotion.empty())
			fail(report, Failure::slides, "only friction, which has reached its limit, holds the " + held.freeMotion + " (" + report.cause + ")");
		return;
	}
	for (const auto& term : system.terms) {
		if (const std::string refusal = term->refusal(d); !refusal.empty()) fail(report, Failure::penetrated, refusal);
		if (const std::string inaccuracy = term->inaccuracy(d); !inaccuracy.empty()) fail(report, Failure::inaccurate, inaccuracy);
	}
}

} // namespace

template <int Dim> StepReport loadStep(PointCloud<Dim>& cloud, const Model<Dim>& model, const Load<Dim>& load, LinearSolver& solver, LastIncrement<Dim>* last)
{
	StepReport report;
	solver.resetTimes();
	// 1. basis functions and populated cells; boundary cells, ghost faces and K_g
	const StepSystem<Dim> system(cloud, model, load, report);
	if (!isHeld(system, cloud, load, report)) return report;
	// 2. to 4. points to nodes, assembly and Newton's method on the nodes
	const Eigen::VectorXd prediction = last && !system.hasInertia() ? predict(*last, system.basis.nodes, load.growth(), model.grid) : Eigen::VectorXd();
	const Eigen::VectorXd d          = equilibrium(system, solver, report, prediction);
	if (!model.terms.empty()) askTerms(system, d, report);
	report.times.linear       = solver.times();
	report.conjugateGradients = solver.iterativeEffort();
	// 5. nodes to points; 6. the grid is reset by not being kept
	report.accepted = report.failure == Failure::tooManyIterations && model.newton.acceptUnconverged;
	if (report.converged() || report.accepted) {
		const Stopwatch watch(report.times.update);
		addReactionsBeyondWalls(system, cloud, load, d, report.reactions);
		if (model.grid.axisymmetric) report.reactions.pop_back(); // of the axis, which nobody has asked for
		PointCloud<Dim> updated = cloud;
		updatePoints(updated, system, d, report);
		if (!requireState(updated, model.grid, report)) return report;
		cloud = std::move(updated);
		for (const auto& term : system.terms)
			term->commit(d);
		for (const auto& [box, wall] : model.walls)
			report.reactions[box].template head<Dim>() += wall->reaction;
		if (last) *last = { system.basis.nodes, d, load.growth() };
	}
	return report;
}

template <int Dim> LinearProblem tangentStiffness(const PointCloud<Dim>& cloud, const Model<Dim>& model)
{
	StepReport report;
	return StepSystem<Dim>(cloud, model, Load<Dim>(), report).tangent();
}

template StepReport    loadStep(PointCloud<2>&, const Model<2>&, const Load<2>&, LinearSolver&, LastIncrement<2>*);
template StepReport    loadStep(PointCloud<3>&, const Model<3>&, const Load<3>&, LinearSolver&, LastIncrement<3>*);
template LinearProblem tangentStiffness(const PointCloud<2>&, const Model<2>&);
template LinearProblem tangentStiffness(const PointCloud<3>&, const Model<3>&);

} // namespace gimpm
