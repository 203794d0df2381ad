// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/engines/MpmDynamicEngine.hpp"
#include "core/parallel/together.hpp"
#include "engine/conditions/boundary/MpmBoundary.hpp"
#include "engine/conditions/contact/MpmContact.hpp"
#include "engine/conditions/flow/MpmFlow.hpp"
#include "engine/conditions/flow/pointMass.hpp"
#include "engine/conditions/shaking/MpmAbsorbingBoundary.hpp"
#include "engine/conditions/water/MpmWater.hpp"
#include "engine/engines/moving.hpp"
#include "engine/parallel/archived.hpp"
#include "engine/parallel/processes.hpp"
#include "engine/points/MaterialPoints.hpp"
#include "engine/points/energies.hpp"
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
	if (flow && scheme == "midpoint")
		throw std::invalid_argument(
		        "MpmDynamicEngine.scheme = 'midpoint' evaluates forces in the middle of a step, and flow the water at its end: take 'newmark' or "
		        "'generalised-alpha'.");
	if (flow && timeTolerance > 0)
		throw std::invalid_argument(
		        "MpmDynamicEngine.timeTolerance = " + std::to_string(timeTolerance)
		        + " sees displacements only, and not the water of flow; leave one of the two out.");
	if (scheme == "generalised-alpha" && rayleigh.second > 0 && !contacts.empty())
		throw std::invalid_argument(
		        "MpmDynamicEngine.rayleigh = (" + std::to_string(rayleigh.first) + ", " + std::to_string(rayleigh.second)
		        + "): damping by stiffness and contact of rigid bodies gain spurious energy together with scheme='generalised-alpha': take "
		          "scheme='newmark', or rayleigh=(alpha, 0).");
}

vector<Listed> MpmDynamicEngine::conditions() const
{
	auto all = MpmImplicitEngine::conditions();
	for (size_t i = 0; i < absorbing.size(); ++i)
		all.push_back({ absorbing[i], "absorbing", i, absorbing.size() });
	return all;
}

std::uint64_t MpmDynamicEngine::checksumInTime() const { return checksumOf(scheme, beta, gamma, rhoInfinity, timeTolerance, rayleigh); }

PointMass MpmDynamicEngine::pointMass() const { return yade::pointMass(flow, gravity); }

// The imbalance is what integration in time and the way of velocities to the grid and back have added.
void MpmDynamicEngine::tellMotion(py::dict& data) const
{
	const auto points = materialPoints(*ownScene(), mask);
	Energies   own    = energiesOf(points, pointMass());
	if (!isElasticEnergyKnown(points)) own.elastic = std::numeric_limits<Real>::quiet_NaN();
	const Energies now = ofAll(own, *holdersOf(*this));
	for (int axis = 0; axis < 3; ++axis) {
		if (axis < grid->dim) data[string("momentum_") + "xyz"[axis]] = now.momentum[axis];
		if (axis == 2 || grid->dim == 3) data[string("angularMomentum_") + "xyz"[axis]] = now.angularMomentum[axis];
	}
	data["kineticEnergy"]   = now.kinetic;
	data["elasticEnergy"]   = now.elastic;
	data["loadWork"]        = loadWork;
	data["boundaryWork"]    = boundaryWork;
	data["contactWork"]     = contactWork;
	data["impactWork"]      = impactWork;
	data["ghostWork"]       = ghostWork;
	data["gridWork"]        = gridWork;
	data["plasticWork"]     = plasticWork;
	data["dampingWork"]     = dampingWork;
	data["frictionWork"]    = frictionWork;
	data["penaltyWork"]     = penaltyWork;
	data["loosePoints"]     = loosePoints;
	data["energyImbalance"] = now.total() - firstEnergy - loadWork - boundaryWork - contactWork + impactWork + ghostWork + gridWork + plasticWork
	        + dampingWork + mergedEnergy;
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
