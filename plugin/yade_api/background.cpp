// SPDX-License-Identifier: GPL-2.0-or-later
#include "yade_api/background.hpp"
#include "yade_api/scene.hpp"

namespace yade {

void endBackgroundRun()
{
	const shared_ptr<ThreadRunner> runner = Singleton<Omega>::instance().simulationLoop;
	if (!runner) return;
	runner->looping = false;
	// A thread that has been started a moment ago takes this lock only later, and then ends at once. Until then
	// nothing shows that it exists: YADE frees the lock when it loads another scene, so that the thread would take
	// one that is no more. Therefore it is never freed.
	new shared_ptr<ThreadRunner>(runner);
	const std::lock_guard<std::mutex> untilItHasEnded(runner->runMutex);
}

bool isRunGoingOn()
{
	const shared_ptr<ThreadRunner> runner = Singleton<Omega>::instance().simulationLoop;
	return runner && runner->looping;
}

} // namespace yade
