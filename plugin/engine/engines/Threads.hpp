// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/points/parallel.hpp"

namespace yade {

// Engine.ompThreads, if set, for the time of a step.
class Threads {
public:
	explicit Threads(int wanted) : before(omp_get_max_threads())
	{
		requireThreadsOfThisProcess(wanted > 0 ? wanted : before);
		if (wanted > 0) omp_set_num_threads(wanted);
	}
	Threads(const Threads&) = delete;
	~Threads() { omp_set_num_threads(before); }

private:
	int before;
};

} // namespace yade
