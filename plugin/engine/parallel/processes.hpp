// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Several processes, started by mpirun, that run the same script and work on each load step together.
#include "core/base/processes.hpp"
#include "core/grid/point_cloud.hpp"
#include "yade_api/types.hpp"
#include <exception>
#include <memory>
#include <stdexcept>

namespace yade {
class Analysis;

// Null: this one alone. All of them call this; it opens the library with MPI. std::invalid_argument if that is not there.
std::shared_ptr<const gimpm::Processes> processes();

// Whether this is the one that writes files and messages.
bool isFirstProcess();

// Whether one of them is asked to give up; null: this one.
bool isRequested(bool here, const gimpm::Processes*);

// Of texts, empty where there is none: that of the first process which has one, in all of them.
string firstSaid(const string& text, const gimpm::Processes&);

// The largest of their numbers.
int largestOf(int, const gimpm::Processes&);

// Where one of them has failed all throw what the first of those has thrown.
void failTogether(const std::exception_ptr&, const gimpm::Processes&);

// Calls f() in each, whose std::invalid_argument is one of all of them: that of the first one which throws.
template <class F> void admitTogether(F&& f, const gimpm::Processes& all)
{
	string refusal;
	try {
		f();
	} catch (const std::invalid_argument& error) {
		refusal = error.what();
	}
	if (const string said = firstSaid(refusal, all); !said.empty()) throw std::invalid_argument(said);
}

// Whether all have come as far as this one. A process that waits for another which has failed would wait for ever.
class Agreement {
public:
	// All are about to divide their points; std::runtime_error where another one has failed, with its reason.
	void meet(const Analysis&);

	// All are about to make a step with these points, which are the same in all unless they are divided; otherwise the same.
	template <int Dim> void reach(const Analysis&, const gimpm::PointCloud<Dim>&, bool areDivided);

	// This one has thrown, before or after reach().
	void breakOff(const std::exception_ptr& thrown);

private:
	bool isAsked = false;
};

} // namespace yade
