// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Lines and lengths as attributes of bars and beams.
#include "yade_api/types.hpp"
#include <cmath>

namespace yade {

// Points as a script gives them: each of two or three numbers.
using Points = vector<vector<Real>>;

inline vector<Vector3r> placesOf(const Points& points)
{
	vector<Vector3r> places;
	for (const auto& x : points)
		places.emplace_back(x[0], x[1], x.size() > 2 ? x[2] : 0);
	return places;
}
inline bool arePoints(const Points& points)
{
	for (const auto& x : points) {
		if (x.size() != 2 && x.size() != 3) return false;
		for (const Real coordinate : x)
			if (!std::isfinite(coordinate)) return false;
	}
	return true;
}
inline bool isLine(const Points& points)
{
	if (points.size() < 2 || !arePoints(points)) return false;
	const auto places = placesOf(points);
	for (size_t i = 1; i < places.size(); ++i)
		if (places[i] == places[i - 1]) return false;
	return true;
}

inline bool isPositiveOrInfinite(Real value) { return value > 0; }
inline bool isNonNegativeOrInfinite(Real value) { return value >= 0; }

} // namespace yade
