// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Errors of an engine must reach the script, also from the background thread of O.run().
//
// YADE loses an exception from action() when the thread has already ended by the time that O.run(n, wait=True) looks at it: the
// script then goes on as if nothing had happened. O.run(n) without wait only writes a line to the log.
#include <exception>

namespace yade {

// Asks Python's main thread to raise the exception that is about to end YADE's background thread, unless YADE raises it itself.
// Does nothing outside that thread.
void raiseInMainThread();

// The body of an engine's action(): errors leave it as usual, and reach the script.
template <class Step> void deliveringErrors(Step&& step)
{
	try {
		step();
	} catch (const std::exception&) {
		raiseInMainThread();
		throw;
	}
}

} // namespace yade
