// SPDX-License-Identifier: GPL-2.0-or-later
// When MpmImplicitEngine runs.
#include "engine/solver/MpmImplicitEngine.hpp"
#include "engine/solver/contacts.hpp"

namespace yade {

bool MpmImplicitEngine::isActivated()
{
	beforeActivation.keep(*this);
	const bool isDue = PeriodicEngine::isActivated(), ends = !isDue && isEndOfLoads();
	nDone += ends;
	if (!isDue && !ends) handOver(contacts, *scene, true);
	return isDue || ends;
}

// An engine that does not run in every iteration would leave out the end of the load curve, where a run usually stops.
bool MpmImplicitEngine::isEndOfLoads() const
{
	const ValueLock lock;
	if (nDone == 0 || (nDo >= 0 && nDone >= nDo) || loadCurve.empty()) return false;
	const Real reached = loadsEnd() - 1e-9 * scene->dt;
	return loadTime < reached && scene->time + scene->dt >= reached;
}

} // namespace yade
