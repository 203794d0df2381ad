// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/messages/progress.hpp"
#include "engine/analysis/analysis.hpp"

namespace yade {

namespace {
	// Last iteration of the run: its stop, or the end of the load curves; 0 if both are behind.
	long lastIteration(const Analysis& engine)
	{
		const Scene& scene       = engine.sceneOfRun();
		const auto   iterationAt = [&](Real time) { return scene.iter + long(std::ceil((time - scene.time) / scene.dt - 1e-6)); };
		if (scene.stopAtIter > scene.iter) return scene.stopAtIter;
		if (scene.stopAtTime > scene.time) return iterationAt(scene.stopAtTime);
		return engine.loadsEnd() > scene.time ? iterationAt(engine.loadsEnd()) : 0;
	}

	string placeOf(const Analysis& engine)
	{
		std::ostringstream text;
		if (engine.isDynamic()) text << "time " << engine.loadTime << " s";
		else
			text << "load factor " << engine.loadFactor;
		return text.str();
	}
}

Progress progressOf(const Analysis& engine, bool isIterationDone)
{
	const Scene& scene     = engine.sceneOfRun();
	const long   step      = scene.iter + 1;
	const bool   runEnds   = scene.stopAtIter > scene.iter && step + engine.period() > scene.stopAtIter;
	const bool   isRunning = Singleton<Omega>::instance().isRunning();
	return { placeOf(engine),    step,      lastIteration(engine),     engine.iterations, engine.cuts, engine.residual, engine.pointsOfRun,
		 engine.isDynamic(), isRunning, isIterationDone && runEnds };
}

} // namespace yade
