// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/python_lock.hpp"
#include <mutex>
#include <optional>

namespace yade {

// Held while values of this plugin's objects are read or written, by an engine in YADE's background thread or by a call
// from Python, but not while an engine computes from copies of them: Python then gets whole values without waiting for
// a step.
//
// Python's own lock would not do: O.reset() keeps it while it waits for the background thread.
class ValueLock {
	static std::recursive_mutex& mutex()
	{
		static std::recursive_mutex only;
		return only;
	}

public:
	ValueLock()
	{
		if (mutex().try_lock()) return;
		std::optional<PythonUnlock> python; // the other thread may need it to refuse a value
		if (PyGILState_Check()) python.emplace();
		mutex().lock();
	}
	ValueLock(const ValueLock&) = delete;
	~ValueLock() { mutex().unlock(); }
};

} // namespace yade
