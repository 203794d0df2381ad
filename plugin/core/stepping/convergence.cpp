// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/convergence.hpp"
#include <algorithm>
#include <cmath>

namespace gimpm {

/// Factor by which the last iteration reduced the residual; 1 if it did not.
double Convergence::reduction() const
{
	const auto& r = residuals_;
	return r.size() < 2 ? 1 : std::min(1., r.back() / r[r.size() - 2]);
}

/// The excess that quadratic convergence leads to in the next iteration.
double Convergence::expected() const { return excess() * std::pow(reduction(), 2); }

bool Convergence::isLastStiffness(bool keepsFactor) const { return expected() <= 1 || (keepsFactor && suffices(expected(), std::pow(reduction(), 2))); }

double Convergence::forcing() const
{
	constexpr double first = 1e-3, part = 0.1, attainable = 1e-13;
	const double     enough = excess() > 0 ? part / excess() : first;
	const double     wanted = expected() <= 1 ? enough : std::max(part * residual(), enough);
	return std::max(attainable, std::min(first, wanted));
}

bool Convergence::isSlow() const
{
	constexpr double slow = 0.1, alike = 0.3, many = 3; // limits for going on: Newton's iterations are few
	const auto&      r = residuals_;
	if (r.size() < 3) return false;
	const double before = r[r.size() - 2] / r[r.size() - 3];
	return reduction() > slow || (reduction() > alike * before && std::log(excess()) > -many * std::log(reduction()));
}

bool Convergence::hasStopped() const
{
	constexpr int several = 4;
	if (int(excesses_.size()) <= several) return false;
	const auto before = excesses_.end() - several;
	return *std::min_element(before, excesses_.end()) > 0.5 * *std::min_element(excesses_.begin(), before);
}

double Convergence::attained() const { return tolerance_ * *std::min_element(excesses_.begin(), excesses_.end()); }

} // namespace gimpm
