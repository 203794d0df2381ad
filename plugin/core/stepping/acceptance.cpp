// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/acceptance.hpp"
#include "core/base/stopwatch.hpp"
#include "core/stepping/energy_gain.hpp"
#include "core/stepping/outcome.hpp"
#include "core/stepping/wall_overhang.hpp"
#include "core/terms/points/divergence_correction.hpp"
#include "core/terms/points/point_update.hpp"
#include "core/terms/points/pressure_filter.hpp"
#include <algorithm>
#include <sstream>

namespace gimpm {
namespace {

/// A domain ends at the axis of symmetry at the latest.
template <int Dim> void keepOffAxis(PointCloud<Dim>& cloud, int p) { cloud.halfSize[p][0] = std::min(cloud.halfSize[p][0], cloud.position[p][0]); }

/// The gradient that a point takes over has the dilation of F-bar.
template <int Dim> void makeEven(const DivergenceCorrection<Dim>& even, bool isRing, Mat<Dim>& gradient, double& hoop)
{
	gradient += even.growth.asDiagonal();
	hoop += even.hoop;
	const Mat<Dim> F     = Mat<Dim>::Identity() + gradient;
	const double   scale = std::pow(even.ratio / (F.determinant() * (1 + hoop)), 1. / (isRing ? 3 : Dim));
	gradient             = scale * F - Mat<Dim>::Identity();
	if (isRing) hoop = scale * (1 + hoop) - 1;
}

/// Step 5: the points take over the converged displacements, and their domains follow by the rule of the model.
template <int Dim> void updatePoints(PointCloud<Dim>& cloud, const StepSystem<Dim>& system, const Eigen::VectorXd& d, StepReport& report)
{
	std::vector<char> clamped(cloud.size(), 0);
	provideInternals(cloud.internals, system.model.materials, cloud.size());
	const auto even = system.model.pressureRelaxation ? divergenceCorrections(cloud, system.basis, system.points, system.model.grid, d)
	                                                  : std::vector<DivergenceCorrection<Dim>>();
	forUpdatedPoints(system.basis, system.points, system.model.materials, d, [&](int p, const PointUpdate<Dim>& u) {
		cloud.position[p] += u.displacement;
		Mat<Dim> gradient = u.gradient;
		double   hoop     = u.hoop;
		if (!even.empty()) {
			cloud.position[p] += even[p].shift;
			makeEven(even[p], !cloud.hoopStretch.empty(), gradient, hoop);
		}
		cloud.defGrad[p]       = (cloud.defGrad[p] + gradient * cloud.defGrad[p]).eval();
		cloud.elasticStrain[p] = u.elasticStrain;
		storeInternals(u.law, u.internals, cloud.internals, p);
		if (!cloud.hoopStretch.empty()) cloud.hoopStretch[p] *= 1 + hoop;
		cloud.stress[p].c = u.kirchhoffStress.c / cloud.volumeRatio(p);
		if (!cloud.excessPressure.empty()) cloud.excessPressure[p] = u.water == 0 ? 0 : -u.water / cloud.volumeRatio(p);
		if (system.model.basis == Basis::gimp) {
			const double   limit = largestHalf(system.model.grid, cloud.position[p]);
			const Vec<Dim> size  = domainOf<Dim>(cloud.defGrad[p], cloud.halfSize0[p], system.model.domains);
			cloud.halfSize[p]    = size.cwiseMin(limit);
			clamped[p] = (size.array() > 0.5 * system.model.grid.size(levelTouched(system.model.grid, cloud.position[p], cloud.halfSize[p]))).any();
			if (!cloud.hoopStretch.empty()) keepOffAxis(cloud, p);
		}
	});
	const Division& division = *system.model.division;
	report.clampedDomains    = int(division.sum(std::count(clamped.begin(), clamped.begin() + division.ownOf(clamped.size()), true)));
}

/// Equilibrium may have been found where no state can be: a point that hardly anything held has left the grid, or has
/// become so flat that numbers do not tell its size. Says so, or nothing.
template <int Dim> std::string impossibleState(const PointCloud<Dim>& cloud, int points, const Grid<Dim>& grid)
{
	const double limit = Grid<Dim>::indexLimit * grid.cellSize;
	for (int p = 0; p < points; ++p) {
		const bool isOnGrid = ((cloud.position[p] - grid.origin).array().abs() < limit).all() && cloud.stress[p].c.allFinite();
		if (isOnGrid && cloud.halfSize[p].minCoeff() > 0 && cloud.defGrad[p].determinant() > 0) continue;
		std::ostringstream text;
		text << "a material point was " << (isOnGrid ? "flattened to nothing, at (" : "thrown off the grid, to (") << cloud.position[p].transpose()
		     << ")";
		return text.str();
	}
	return "";
}

/// The report says what the first process says that has found such a point.
template <int Dim> bool requireState(const PointCloud<Dim>& cloud, const Model<Dim>& model, StepReport& report)
{
	const Division&   division = *model.division;
	const std::string wrong    = division.firstSaid(impossibleState(cloud, division.ownOf(cloud.size()), model.grid));
	if (wrong.empty()) return true;
	report.cause    = wrong;
	report.failure  = Failure::diverging;
	report.accepted = false;
	return false;
}

/// Requires the same points in all processes, as the computation goes on from them. The report says so if they differ.
template <int Dim> bool requireSamePoints(const PointCloud<Dim>& cloud, const Model<Dim>& model, StepReport& report)
{
	if (!model.division->isWhole() || haveSamePoints(*model.processes, cloud)) return true;
	fail(report, Failure::apart, "the processes have come to different states of the points");
	report.accepted = false;
	return false;
}

} // namespace

void testError(const LocalError& error, StepReport& report)
{
	const double found = error.size / error.tolerance;
	if (found > report.localError) report.localError = found, report.errorOrder = error.order;
	if (error.size <= error.tolerance) return;
	std::ostringstream text;
	text << "the local error of the " << error.of << ", " << error.size << ' ' << error.unit << ", is above the tolerance, " << error.tolerance << ' '
	     << error.unit;
	fail(report, Failure::inaccurate, text.str());
}

template <int Dim> void askForRefusals(const StepSystem<Dim>& system, const Eigen::VectorXd& d, StepReport& report)
{
	for (const auto& term : system.terms) {
		if (const Refusal refusal = term->refusal(d); !refusal.cause.empty()) {
			fail(report, refusal.failure, refusal.cause);
			report.advice = refusal.advice;
		}
		testError(term->localError(d), report);
	}
}

template <int Dim> void testFieldErrors(const StepSystem<Dim>& system, const Eigen::VectorXd& growth, StepReport& report)
{
	const State state = system.state(growth);
	for (const auto* term : system.coupled())
		for (const LocalError& error : term->fieldErrors(state))
			testError(error, report);
}

template <int Dim> bool accept(const StepSystem<Dim>& system, PointCloud<Dim>& cloud, const Eigen::VectorXd& d, StepReport& report)
{
	const Stopwatch       watch(report.times.update);
	const Eigen::VectorXd displacements = system.map.displacements(d);
	addReactionsBeyondWalls(system, displacements, report);
	if (system.model.grid.axisymmetric) report.reactions.pop_back(); // axis, which nobody has asked for
	PointCloud<Dim> updated = cloud;
	updatePoints(updated, system, displacements, report);
	keepBeforeWalls(updated, cloud, system, displacements);
	if (system.model.pressureRelaxation) relaxPressures(updated, cloud, system.model.materials, system.basis, system.model.grid, *system.model.division);
	if (!requireState(updated, system.model, report) || !requireSamePoints(updated, system.model, report)) return false;
	if (!report.accepted && !requireEnergy(system, cloud, updated, displacements, report)) return false;
	cloud = std::move(updated);
	system.commit(d);
	for (const auto& [box, wall] : system.model.walls)
		report.reactions[box].template head<Dim>() += wall->reaction;
	return true;
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template void askForRefusals(const StepSystem<Dim>&, const Eigen::VectorXd&, StepReport&);                                                             \
	template void testFieldErrors(const StepSystem<Dim>&, const Eigen::VectorXd&, StepReport&);                                                            \
	template bool accept(const StepSystem<Dim>&, PointCloud<Dim>&, const Eigen::VectorXd&, StepReport&);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
