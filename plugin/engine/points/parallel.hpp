// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Work on many bodies, shared among the threads that YADE was given (yade -j).
#include <exception>
#include <omp.h>
#include <stdexcept>
#include <unistd.h>
#include <vector>

namespace yade {

// Process that opened this library.
inline const pid_t firstProcess = getpid();

// To be asked before several threads work. GNU OpenMP keeps them for the next time, and YADE has had some even before
// the first step; a process that is forked then waits for ever for those, which it does not have.
inline void requireThreadsOfThisProcess(int threads)
{
	if (threads == 1 || getpid() == firstProcess) return;
	throw std::runtime_error(
	        "This process was forked (os.fork, multiprocessing) from a YADE with several threads, which it does not have. Start YADE with -j1, or set ompThreads = 1 of "
	        "the engine.");
}

// Calls f(begin, end) for ranges that make up [0, n), a thread each; a process that was forked has one. Of what they
// throw, that of the first range is thrown.
template <class F> void inRanges(size_t n, F f)
{
	constexpr size_t                worthwhile = 2000; // bodies for which to wake another thread
	const int                       threads    = getpid() == firstProcess ? omp_get_max_threads() : 1;
	const int                       ranges     = int(std::min<size_t>(threads, 1 + n / worthwhile));
	std::vector<std::exception_ptr> thrown(ranges);
#pragma omp parallel for num_threads(ranges) schedule(static, 1)
	for (int r = 0; r < ranges; ++r)
		try {
			f(n * r / ranges, n * (r + 1) / ranges);
		} catch (...) {
			thrown[r] = std::current_exception();
		}
	for (const auto& exception : thrown)
		if (exception) std::rethrow_exception(exception);
}

} // namespace yade
