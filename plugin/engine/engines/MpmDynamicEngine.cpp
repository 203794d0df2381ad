// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/engines/MpmDynamicEngine.hpp"
#include "engine/engines/moving.hpp"
#include "engine/points/MaterialPoints.hpp"
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

template <int Dim> void MpmDynamicEngine::makeMoving(Job<Dim>& job, const vector<MaterialPoint>& points)
{
	job.moving = std::make_shared<Moving<Dim>>(*this, job, points);
}

void MpmDynamicEngine::setMoving(Job<2>& job, const vector<MaterialPoint>& points) { makeMoving(job, points); }
void MpmDynamicEngine::setMoving(Job<3>& job, const vector<MaterialPoint>& points) { makeMoving(job, points); }

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmDynamicEngine)
static const yade::PluginClasses<yade::MpmDynamicEngine> registeredMpmDynamicEngine(__FILE__);
