// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/stepping/load_curve.hpp"
#include <algorithm>
#include <cmath>

namespace gimpm {

bool LoadCurve::isAdmissible(const Knees& knees)
{
	for (std::size_t i = 0; i < knees.size(); ++i)
		if (!std::isfinite(knees[i].first) || !std::isfinite(knees[i].second) || (i > 0 && knees[i].first <= knees[i - 1].first)) return false;
	return !knees.empty();
}

double LoadCurve::valueAt(const Knees& knees, double time)
{
	const auto after = std::lower_bound(knees.begin(), knees.end(), time, [](const auto& knee, double t) { return knee.first < t; });
	if (after == knees.begin()) return after->second;
	if (after == knees.end()) return knees.back().second;
	const auto [t0, f0] = *(after - 1);
	const auto [t1, f1] = *after;
	return f0 + (f1 - f0) * (time - t0) / (t1 - t0);
}

} // namespace gimpm
