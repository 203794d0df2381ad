// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/MpmDynamicEngine.hpp"
#include "engine/points/MaterialPoints.hpp"
#include "engine/solver/moving.hpp"
#include "yade_api/registration.hpp"

namespace yade {

gimpm::TimeScheme MpmDynamicEngine::timeScheme() const
{
	if (scheme == "newmark") return gimpm::TimeScheme::newmark(beta, gamma);
	if (isExplicit()) return gimpm::TimeScheme::centralDifferences();
	return scheme == "midpoint" ? gimpm::TimeScheme::midpoint() : gimpm::TimeScheme::generalisedAlpha(rhoInfinity);
}

Real MpmDynamicEngine::ghostMass() const
{
	if (ghost->factor == 0) return 0; // there are no faces
	if (!std::isnan(ghost->massFactor)) return ghost->massFactor;
	return isExplicit() ? MpmGhost::usualExplicitMassFactor : MpmGhost::usualMassFactor;
}

void MpmDynamicEngine::requireAdmissible() const
{
	Exposed<MpmDynamicEngine, MpmImplicitEngine>::requireAdmissible();
	if (isExplicit()) requireExplicit(*this);
	if (newton->stepTolerance > 0)
		throw std::invalid_argument(
		        "MpmNewton.stepTolerance = " + std::to_string(newton->stepTolerance)
		        + " is of quasi-static steps: MpmDynamicEngine has timeTolerance for that; leave stepTolerance=0.");
	if (scheme == "midpoint" && timeTolerance > 0)
		throw std::invalid_argument(
		        "MpmDynamicEngine.timeTolerance = " + std::to_string(timeTolerance)
		        + " needs accelerations at both ends of a step, which scheme='midpoint' does without: take 'newmark' or 'generalised-alpha'.");
}

// YADE's integrator moves every body that its mask means, also blocked ones, by the velocity.
void MpmDynamicEngine::requireOnlyMover(const vector<MaterialPoint>& points) const
{
	const auto isIntegrator = [](const auto& e) { return e->getClassName() == "NewtonIntegrator" && !e->dead; };
	if (std::none_of(scene->engines.begin(), scene->engines.end(), isIntegrator)) return;
	const auto found = std::lower_bound(points.begin(), points.end(), watched, [](const MaterialPoint& p, Body::id_t id) { return p.id < id; });
	if (found == points.end() || found->id != watched) return;
	const Vector3r moved = found->state->pos - watchedAt, along = found->state->vel.normalized();
	if (moved.isZero(0) || (moved - along * along.dot(moved)).norm() > 1e-6 * moved.norm()) return;
	throw std::invalid_argument(
	        "MpmDynamicEngine: body #" + std::to_string(watched)
	        + ", a material point, has been moved along its velocity between two steps, as a NewtonIntegrator without a mask does with all bodies: give material "
	          "points and grains different groupMasks, and that of the grains to the integrator, as in NewtonIntegrator(mask=1) with groupMask = 2 for the points.");
}

template <int Dim> void MpmDynamicEngine::makeMoving(Job<Dim>& job, const vector<MaterialPoint>& points)
{
	requireOnlyMover(points);
	job.moving = std::make_shared<Moving<Dim>>(*this, job, points);
}

void MpmDynamicEngine::setMoving(Job<2>& job, const vector<MaterialPoint>& points) { makeMoving(job, points); }
void MpmDynamicEngine::setMoving(Job<3>& job, const vector<MaterialPoint>& points) { makeMoving(job, points); }

void MpmDynamicEngine::action()
{
	MpmImplicitEngine::action();
	watch();
}

void MpmDynamicEngine::watch()
{
	const ValueLock lock;
	Real            fastest = 0;
	for (const MaterialPoint& point : points)
		if (const Real speed = point.state->vel.squaredNorm(); speed > fastest) fastest = speed, watched = point.id, watchedAt = point.state->pos;
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmDynamicEngine)
static const yade::PluginClasses<yade::MpmDynamicEngine> registeredMpmDynamicEngine(__FILE__);
