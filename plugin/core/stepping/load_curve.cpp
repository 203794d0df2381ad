// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/load_curve.hpp"
#include <cmath>

namespace gimpm {

bool LoadCurve::isAdmissible(const Knees& knees)
{
	for (std::size_t i = 0; i < knees.size(); ++i)
		if (!std::isfinite(knees[i].first) || !std::isfinite(knees[i].second) || (i > 0 && knees[i].first <= knees[i - 1].first)) return false;
	return !knees.empty();
}

double LoadCurve::valueAt(double time) const
{
	if (time <= knees_.front().first) return knees_.front().second;
	for (std::size_t i = 1; i < knees_.size(); ++i) {
		const auto [t0, f0] = knees_[i - 1];
		const auto [t1, f1] = knees_[i];
		if (time <= t1) return f0 + (f1 - f0) * (time - t0) / (t1 - t0);
	}
	return knees_.back().second;
}

} // namespace gimpm
