// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/step_control.hpp"
#include <algorithm>
#include <cmath>

namespace gimpm {

bool canBeCut(Failure failure)
{
	return failure == Failure::singular || failure == Failure::inverted || failure == Failure::noResponse || failure == Failure::notFinite
	        || failure == Failure::diverging || failure == Failure::tooManyIterations || failure == Failure::slides || failure == Failure::penetrated
	        || failure == Failure::inaccurate;
}

double StepControl::part() const { return std::min(part_, 1 - done_); }

/// The part that was made may have been a rest.
bool StepControl::mayGrow(const StepReport& report) const
{
	return report.iterations <= maxIterations_ / 3 && report.localError * std::pow(2 * part_ / part(), 3) <= 1;
}

double StepControl::cut(const StepReport& report) const
{
	double smaller = part() / 2;
	for (double error = report.localError / 8; error > 1 && smaller / 2 >= leastPart_; error /= 8)
		smaller /= 2;
	return smaller;
}

bool StepControl::take(const StepReport& report)
{
	if (report.converged() || report.accepted) {
		const bool grows = mayGrow(report);
		done_            = goal();
		if (grows) part_ = std::min(1., 2 * part_);
		return true;
	}
	const bool isCut = canBeCut(report.failure) && !isLeast();
	part_            = isCut ? cut(report) : 1;
	cuts_ += isCut;
	return isCut;
}

} // namespace gimpm
