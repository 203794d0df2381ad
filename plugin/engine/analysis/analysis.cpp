// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/analysis/analysis.hpp"
#include <algorithm>

namespace yade {

Real Analysis::loadsEnd() const
{
	Real end = std::max(curveOfLoads().end(), curveOfGravity().end());
	for (const Listed& listed : conditions())
		end = std::max(end, listed.condition->end(*this));
	return end;
}

void Analysis::requireConditions() const
{
	for (const Listed& listed : conditions())
		listed.condition->requireAdmissible();
}

bool Analysis::bodiesMeet() const
{
	const auto all = conditions();
	return std::any_of(all.begin(), all.end(), [](const Listed& listed) { return listed.condition->partsBodies(); });
}

size_t Analysis::countOf(const string& list) const
{
	const auto all = conditions();
	return std::count_if(all.begin(), all.end(), [&](const Listed& listed) { return listed.list == list; });
}

} // namespace yade
