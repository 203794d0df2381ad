// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <atomic>

namespace yade {

// Mark that an engine is between taking over the values of the material points and giving them back, while this object
// lives.
class AtWork {
public:
	AtWork() { ++engines; }
	~AtWork() { --engines; }
	AtWork(const AtWork&)            = delete;
	AtWork& operator=(const AtWork&) = delete;

	static bool isAny() { return engines > 0; } // true if there is any, in any scene

private:
	static inline std::atomic_int engines { 0 };
};

} // namespace yade
