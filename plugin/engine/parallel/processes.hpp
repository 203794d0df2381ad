// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The processes that run the same script and work on each load step together: this one alone, or those that mpirun has
// started.
#include "core/grid/point_cloud.hpp"
#include "core/parallel/division.hpp"
#include "yade_api/types.hpp"
#include <exception>
#include <memory>
#include <stdexcept>

namespace yade {
class Analysis;

// Processes of the run. All of several call this; it opens the library with MPI. std::invalid_argument if that is not
// there.
std::shared_ptr<const gimpm::Processes> processes();

// True in the process that writes files and messages.
bool isFirstProcess();

// True if one of them is asked to give up.
bool isRequested(bool here, const gimpm::Processes&);

// The largest of their numbers.
int largestOf(int, const gimpm::Processes&);

// Throws in all processes what the first failed one has thrown: a std::invalid_argument, or a
// std::runtime_error.
void failTogether(const std::exception_ptr&, const gimpm::Processes&);

// Calls f() in each of them; whatever one throws, all do. None is left waiting for one that has failed.
template <class F> void together(F&& f, const gimpm::Processes& all)
{
	std::exception_ptr thrown;
	try {
		f();
	} catch (...) {
		thrown = std::current_exception();
	}
	failTogether(thrown, all);
}

// Check that all have come as far as this one. A process that waits for another which has failed would wait for ever.
class Agreement {
public:
	// All are about to divide their points; std::runtime_error where another one has failed, with its reason.
	void meet(const Analysis&);

	// All are about to make a step with these points, which are the same in all unless they are divided among them;
	// otherwise the same.
	template <int Dim> void reach(const Analysis&, const gimpm::PointCloud<Dim>&, const gimpm::Division&);

	// This one has thrown, before or after reach().
	void breakOff(const std::exception_ptr& thrown);

private:
	template <class F> void requireAgreement(const Analysis&, F&& haveSamePoints);

	bool isAsked = false;
};

} // namespace yade
