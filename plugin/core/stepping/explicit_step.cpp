// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/explicit_step.hpp"
#include "core/base/stopwatch.hpp"
#include "core/parallel/halo.hpp"
#include "core/stepping/acceptance.hpp"
#include "core/stepping/outcome.hpp"
#include "core/stepping/wall_overhang.hpp"
#include "core/terms/inertia/explicit_inertia.hpp"

namespace gimpm {
namespace {

template <int Dim> std::string namesOfMeetings(const Motion<Dim>& motion)
{
	std::string names = "bodies of points";
	const auto& all   = *motion.bodies;
	for (const auto& meeting : all.meetings)
		names += (&meeting == all.meetings.data() ? " '" : ", '") + all.bodies[meeting.slave].name + "' and '" + all.bodies[meeting.master].name + "'";
	return names;
}

/// True if the step can be made at all.
template <int Dim> bool isPossible(const StepSystem<Dim>& system, const ExplicitInertia<Dim>& inertia, const Motion<Dim>& motion, StepReport& report)
{
	if (!system.map.isAlone())
		return !fail(report, Failure::misplaced, "explicit steps are for displacements only, and there is the field '" + system.map[1].name + "'");
	if (isObstructed(system, report)) return false;
	if (const std::string obstacle = inertia.obstacle(); !obstacle.empty()) return !fail(report, Failure::misplaced, obstacle);
	if (inertia.isSingular()) return !fail(report, Failure::singular, "the mass matrix is singular to working precision");
	return inertia.meets() || !fail(report, Failure::diverging, "the forces with which " + namesOfMeetings(motion) + " end the step are not found");
}

/// External forces less those that resist at the end of the step, with the displacements d.
template <int Dim> bool balance(const StepSystem<Dim>& system, const Eigen::VectorXd& d, Eigen::VectorXd& imbalance, StepReport& report)
{
	const Stopwatch watch(report.times.assembly);
	Eigen::VectorXd force;
	if (const auto failure = system.evaluate(d, force, nullptr)) return !fail(report, *failure);
	imbalance = system.external - force;
	return imbalance.allFinite() || !fail(report, Failure::notFinite, "forces are not finite numbers any more");
}

} // namespace

template <int Dim> StepReport explicitStep(PointCloud<Dim>& cloud, const Model<Dim>& model, const Load<Dim>& load, Motion<Dim>& motion)
{
	StepReport report;
	const Halo halo(cloud, *model.division, [&] { return pointsForOthers(cloud, model); });
	// 1. basis functions and populated cells; boundary cells and ghost faces
	const StepSystem<Dim> system(cloud, model, load, report);
	// 2. points to nodes: velocities in the middle of the step, and so the displacements
	ExplicitInertia<Dim> inertia(motion, system.context());
	if (!isPossible(system, inertia, motion, report)) return report;
	const Eigen::VectorXd d = inertia.displacements();
	// 3. the forces at the end of the step
	Eigen::VectorXd imbalance;
	if (!balance(system, d, imbalance, report)) return report;
	askForRefusals(system, d, report);
	if (!report.converged()) return report;
	// 4. accelerations there, and what holds the constrained nodes
	report.reactions                     = reactions(system, Eigen::VectorXd(system.external + inertia.accelerate(imbalance)));
	report.conjugateGradients.iterations = inertia.iterations();
	report.times.linear.solve            = inertia.seconds();
	if (inertia.isSingular()) return fail(report, Failure::singular, "the mass matrix is singular to working precision"), report;
	// 5. nodes to points; 6. the grid is reset by not being kept
	if (accept(system, cloud, d, report)) {
		inertia.commit();
		addInertiaBeyondWalls(system, motion, report);
	}
	return report;
}

template StepReport explicitStep(PointCloud<2>&, const Model<2>&, const Load<2>&, Motion<2>&);
template StepReport explicitStep(PointCloud<3>&, const Model<3>&, const Load<3>&, Motion<3>&);

} // namespace gimpm
