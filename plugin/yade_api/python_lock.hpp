// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/types.hpp"
#include <atomic>
#include <functional>

namespace yade {

// Python's global lock, for code that may run in YADE's background thread, which does not hold it during O.run().
class PythonLock {
	const PyGILState_STATE state = PyGILState_Ensure();

public:
	PythonLock()                  = default;
	PythonLock(const PythonLock&) = delete;
	~PythonLock() { PyGILState_Release(state); }
};

// Calls f with that lock, in YADE's background thread. O.reset() keeps the lock while it waits for that thread to end,
// after telling it so: then f is not waited for, and may be called much later. So it must own what it uses.
void withPython(const std::atomic_bool& isWanted, std::function<void()> f);

// The opposite of PythonLock, for a call from Python that waits for something which may itself need that lock.
class PythonUnlock {
	PyThreadState* const state = PyEval_SaveThread();

public:
	PythonUnlock()                    = default;
	PythonUnlock(const PythonUnlock&) = delete;
	~PythonUnlock() { PyEval_RestoreThread(state); }
};

} // namespace yade
