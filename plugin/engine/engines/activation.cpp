// SPDX-License-Identifier: GPL-2.0-or-later
// When MpmImplicitEngine runs.
#include "engine/conditions/contact/contacts.hpp"
#include "engine/engines/MpmImplicitEngine.hpp"

namespace yade {

bool MpmImplicitEngine::isActivated()
{
	beforeActivation.keep(*this);
	join();
	wasAway          = wasAway || (seen >= 0 && scene->iter > seen + 1);
	seen             = scene->iter;
	const bool isDue = PeriodicEngine::isActivated(), ends = !isDue && isEndOfLoads();
	nDone += ends;
	if (!isDue && !ends) handOver(contacts, *scene, true);
	return isDue || ends;
}

// Grains may have been poured for a while before. What has run, or was given another time, goes on from there.
void MpmImplicitEngine::join()
{
	const ValueLock lock;
	if (!hasJoined && nDone == 0 && loadTime == 0) loadTime = scene->time;
	hasJoined = true;
}

// YADE asks no engine that is dead, or not among O.engines.
string MpmImplicitEngine::doubtOfAbsence()
{
	const Real goal = scene->time + scene->dt;
	if (!wasAway || goal <= loadTime) return "";
	wasAway = false;
	std::ostringstream text;
	text << "it was dead or out of O.engines for some time: this step makes up for that and goes from loadTime = " << loadTime << " to " << goal
	     << " s at once. Where the soil shall have stood still, set loadTime = O.time first.";
	return text.str();
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
