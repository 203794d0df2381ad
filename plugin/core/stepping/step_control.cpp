// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/step_control.hpp"
#include <algorithm>

namespace gimpm {

bool canBeCut(Failure failure)
{
	return failure == Failure::singular || failure == Failure::inverted || failure == Failure::noResponse || failure == Failure::notFinite
	        || failure == Failure::diverging || failure == Failure::tooManyIterations || failure == Failure::slides || failure == Failure::penetrated
	        || failure == Failure::inaccurate;
}

double StepControl::part() const { return std::min(part_, 1 - done_); }

bool StepControl::take(const StepReport& report)
{
	if (report.converged() || report.accepted) {
		done_ = goal();
		if (report.iterations <= maxIterations_ / 3) part_ = std::min(1., 2 * part_);
		return true;
	}
	const bool isCut = canBeCut(report.failure) && !isLeast();
	part_            = isCut ? part() / 2 : 1;
	cuts_ += isCut;
	return isCut;
}

} // namespace gimpm
