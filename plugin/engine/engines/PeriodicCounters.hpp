// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/yade_api.hpp"

namespace yade {

// Counters of a PeriodicEngine. They move on before action() is called: after a failed step they are put back, and the
// same iteration runs again.
struct PeriodicCounters {
	Real virtLast = 0, realLast = 0;
	long iterLast = 0, nDone = 0;

	void keep(const PeriodicEngine& engine) { *this = { engine.virtLast, engine.realLast, engine.iterLast, engine.nDone }; }
	void putBack(PeriodicEngine& engine) const
	{
		engine.virtLast = virtLast;
		engine.realLast = realLast;
		engine.iterLast = iterLast;
		engine.nDone    = nDone;
	}
};

} // namespace yade
