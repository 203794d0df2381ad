// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Errors of an engine must reach the script, also from the background thread of O.run().
//
// YADE keeps an exception of that thread for O.wait() to raise. But O.run(n, wait=True) returns silently if the thread
// has already ended when it begins to wait, and O.run(n) only writes a line to the log, which O.run(n, wait=True)
// writes besides.
#include <omp.h>
#include <stdexcept>

namespace yade {

class Scene;

// Ends a step that is given up on request: whoever asked knows.
struct Interrupted : std::runtime_error {
	using runtime_error::runtime_error;
};

// In YADE's background thread: ends it, and has the script raise the exception, once. Does nothing outside that thread.
void endRun(const std::exception&);

// Ends the run and has the script raise the error as soon as Python executes again: in an OpenMP region in a step of a
// scene, which no exception may leave. The first one of a step counts.
void raiseLater(const std::exception&, const Scene&);

// The body of an engine's action(): errors leave it as usual, and reach the script. YADE's ParallelEngine calls it in
// an OpenMP region.
template <class Step> void deliveringErrors(const Scene& scene, Step&& step)
{
	try {
		step();
	} catch (const Interrupted&) {
		throw;
	} catch (const std::exception& error) {
		if (omp_get_level() > 0) return raiseLater(error, scene);
		endRun(error);
		throw;
	}
}

} // namespace yade
