// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/step_control.hpp"
#include <algorithm>
#include <cmath>

namespace gimpm {

bool canBeCut(Failure failure)
{
	return failure == Failure::singular || failure == Failure::inverted || failure == Failure::noResponse || failure == Failure::notFinite
	        || failure == Failure::diverging || failure == Failure::tooManyIterations || failure == Failure::slides || failure == Failure::penetrated
	        || failure == Failure::refused || failure == Failure::inaccurate || failure == Failure::gainsEnergy || failure == Failure::stabilised;
}

double StepControl::part() const { return std::min(part_, 1 - done_); }

/// The part that was made may have been a rest. The cube is that of time steps. Without inertia, where the error
/// goes with the square, the rest is a margin: a part that is undone costs more than one that could have been longer.
bool StepControl::mayGrow(const StepReport& report) const
{
	return report.iterations <= maxIterations_ / 3 && report.localError * std::pow(2 * part_ / part(), 3) <= 1;
}

void StepControl::beginAnew()
{
	while (part() > firstPart && !isLeast())
		part_ = part() / 2;
}

double StepControl::cut(const StepReport& report) const
{
	const double less    = std::pow(2, report.errorOrder);
	double       smaller = part() / 2;
	for (double error = report.localError / less; error > 1 && smaller / 2 >= leastPart_; error /= less)
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
