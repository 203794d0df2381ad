// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/structures/edge_of_soil.hpp"
#include <algorithm>

namespace gimpm {
namespace {

/// Largest distance of the centres of points that may fill the cell beyond a position from it [cells].
constexpr double reachOfPoints = 2;

/// Length of an interval around a centre that lies in another one.
double overlap(double middle, double half, double low, double high) { return std::max(0., std::min(middle + half, high) - std::max(middle - half, low)); }

} // namespace

EdgeOfSoil::EdgeOfSoil(const std::vector<Vec<2>>& line, double cellSize, const PointCloud<2>& cloud)
        : cloud_(cloud), cellSize_(cellSize), reach_(reachOfPoints * cellSize)
{
	Vec<2> low = line.front(), high = low;
	for (const Vec<2>& position : line)
		low = low.cwiseMin(position), high = high.cwiseMax(position);
	(high - low).maxCoeff(&axis_);
	low.array() -= reach_, high.array() += reach_;
	for (int p = 0; p < int(cloud.size()); ++p)
		if ((cloud.position[p] - low).minCoeff() >= 0 && (high - cloud.position[p]).minCoeff() >= 0) points_.push_back(p);
	std::sort(points_.begin(), points_.end(), [&](int p, int q) { return cloud.position[p][axis_] < cloud.position[q][axis_]; });
}

std::vector<int> EdgeOfSoil::around(const Vec<2>& position, const BesideLine& isBeside) const
{
	const auto       along = [&](int p) { return cloud_.position[p][axis_]; };
	const auto       first = std::lower_bound(points_.begin(), points_.end(), position[axis_] - reach_, [&](int p, double x) { return along(p) < x; });
	std::vector<int> near;
	for (auto p = first; p != points_.end() && along(*p) <= position[axis_] + reach_; ++p)
		if ((cloud_.position[*p] - position).cwiseAbs().maxCoeff() <= reach_ && isBeside(*p)) near.push_back(*p);
	std::sort(near.begin(), near.end());
	return near;
}

double EdgeOfSoil::from(const Vec<2>& position, const Vec<2>& n, const BesideLine& isBeside) const
{
	const double h = cellSize_, window = h / 2;
	const Vec<2> t(-n[1], n[0]);
	double       before = 0, behind = 0;
	for (const int p : around(position, isBeside)) {
		const Vec<2> apart     = cloud_.position[p] - position;
		const auto   halfAlong = [&](const Vec<2>& e) { return e.cwiseProduct(cloud_.halfSize[p]).norm(); };
		const double along     = overlap(apart.dot(t), halfAlong(t), -window, window);
		before += along * overlap(apart.dot(n), halfAlong(n), -h, h / 2);
		behind += along * overlap(apart.dot(n), halfAlong(n), h / 2, h);
	}
	if (behind == 0) return 0;
	return std::clamp(h / 2 * (1 - before / behind), -h / 2, h / 2);
}

} // namespace gimpm
