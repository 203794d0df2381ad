// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <atomic>

namespace yade {

// As long as it lives, an engine is between taking over the values of the material points and giving them back.
class AtWork {
public:
	AtWork() { ++engines; }
	~AtWork() { --engines; }
	AtWork(const AtWork&)            = delete;
	AtWork& operator=(const AtWork&) = delete;

	static bool isAny() { return engines > 0; } // of whatever scene

private:
	static inline std::atomic_int engines { 0 };
};

} // namespace yade
