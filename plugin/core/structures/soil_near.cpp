// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/structures/soil_near.hpp"
#include <algorithm>

namespace gimpm {

template <int Dim>
std::vector<SoilNear<Dim>> soilNear(
        const std::vector<Vec<Dim>>& positions, const std::vector<double>& reach, const StepContext<Dim>& step, const std::function<bool(int)>& isTaken)
{
	const double farthest = *std::max_element(reach.begin(), reach.end());
	const auto&  cloud    = step.cloud;
	Vec<Dim>     low = positions.front(), high = low;
	for (const Vec<Dim>& position : positions)
		low = low.cwiseMin(position), high = high.cwiseMax(position);
	low.array() -= farthest, high.array() += farthest;

	std::vector<SoilNear<Dim>> near(positions.size());
	std::vector<double>        weight(positions.size(), 0);
	for (std::size_t p = 0; p < cloud.size(); ++p) {
		const Vec<Dim>& x = cloud.position[p];
		if (!step.grid.isPeriodic() && ((x - low).minCoeff() < 0 || (high - x).minCoeff() < 0)) continue;
		if (isTaken && !isTaken(int(p))) continue;
		std::optional<VolumeAndModulus> soil;
		for (std::size_t i = 0; i < positions.size(); ++i) {
			double nearness = 1;
			for (int a = 0; a < Dim && nearness > 0; ++a) {
				const double length = step.grid.cellSize * step.grid.period[a], apart = positions[i][a] - x[a];
				const double nearest = length > 0 ? apart - length * std::round(apart / length) : apart;
				nearness *= std::max(0., 1 - std::abs(nearest) / reach[i]);
			}
			if (nearness == 0) continue;
			if (!soil) soil = step.stiffnessOf(int(p));
			nearness *= soil->volume;
			weight[i] += nearness;
			near[i].young += nearness * soil->modulus;
			near[i].stress.c += nearness * cloud.stress[p].c;
		}
	}
	for (std::size_t i = 0; i < positions.size(); ++i)
		if (weight[i] > 0) near[i].young /= weight[i], near[i].stress.c /= weight[i];
	return near;
}

template std::vector<SoilNear<2>> soilNear(const std::vector<Vec<2>>&, const std::vector<double>&, const StepContext<2>&, const std::function<bool(int)>&);
template std::vector<SoilNear<3>> soilNear(const std::vector<Vec<3>>&, const std::vector<double>&, const StepContext<3>&, const std::function<bool(int)>&);

} // namespace gimpm
