// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/analysis/RunResults.hpp"

namespace yade {

namespace {
	template <class T> const T& toPython(const T& value) { return value; }
	py::list                    toPython(const vector<Real>& values)
	{
		py::list list;
		for (const Real value : values)
			list.append(value);
		return list;
	}
}

void RunResults::begin(size_t points)
{
	results([this](const char*, auto member, const auto& source, auto&&...) { source.begin(this->*member); });
	last        = gimpm::StepReport();
	pointsOfRun = points;
	times.clear();
}

void RunResults::take(const gimpm::StepReport& report, TimingDeltas& timing)
{
	results([&](const char*, auto member, const auto& source, auto&&...) { source.take(this->*member, report); });
	last          = report;
	const auto& t = report.times;
	for (const auto& [phase, seconds] : { std::pair { "basis", t.basis },
	                                      { "ghost", t.ghost },
	                                      { "assembly", t.assembly },
	                                      { "analyse", t.linear.analyse },
	                                      { "factorise", t.linear.factorise },
	                                      { "solve", t.linear.solve },
	                                      { "update", t.update } })
		addTime(timing, phase, seconds);
}

void RunResults::tell(py::dict& dict, Told by) const
{
	results([&](const char* name, auto member, const auto&, Told told, auto&&...) {
		if (told >= by) dict[name] = toPython(this->*member);
	});
}

void RunResults::addTime(TimingDeltas& timing, const char* phase, double seconds)
{
	timing.add(phase, std::chrono::nanoseconds(std::llround(1e9 * seconds)));
	times[phase] += seconds;
}

} // namespace yade
