// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Request to give up a long step: O.pause(), O.reset(), the end of the process, or Ctrl-C.
//
// YADE waits for its background thread, in O.run(n, wait=True) and O.wait(), without looking at signals: Python would
// raise KeyboardInterrupt only when the whole run is over. So that thread looks itself.
#include "yade_api/scene.hpp"

namespace yade {

class Interruption {
public:
	// In the thread that is about to make a step: the one that holds Python's lock (O.step()), or YADE's background
	// thread.
	Interruption();

	bool isBackground() const { return inBackground; }

	// To be asked now and then. Python's own handlers of signals run in here; what they raise is kept for raise().
	bool isRequested();

	// Ends the step: with what Python's handler has raised; after Ctrl-C in the background with Interrupted;
	// otherwise whoever asked for it is waiting for just that, and the thread ends without a word.
	[[noreturn]] void raise(const string& message) const;

	// When Python is there: lets O.wait() raise KeyboardInterrupt after Ctrl-C.
	static void prepare();

private:
	bool pressedWhileYadeWaits();

	const bool          inBackground;
	const ThreadRunner* runner; // outlives the step of its thread
	bool                byKey = false;
	PyObject *          type = nullptr, *value = nullptr, *traceback = nullptr; // exception that Python's handler has raised
};

} // namespace yade
