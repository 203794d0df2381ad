// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/types.hpp"

namespace yade {

// Python's global lock, for code that may run in YADE's background thread, which does not hold it during O.run().
class PythonLock {
	const PyGILState_STATE state = PyGILState_Ensure();

public:
	PythonLock()                  = default;
	PythonLock(const PythonLock&) = delete;
	~PythonLock() { PyGILState_Release(state); }
};

// The opposite, for a call from Python that waits for something which may itself need that lock.
class PythonUnlock {
	PyThreadState* const state = PyEval_SaveThread();

public:
	PythonUnlock()                    = default;
	PythonUnlock(const PythonUnlock&) = delete;
	~PythonUnlock() { PyEval_RestoreThread(state); }
};

} // namespace yade
