// SPDX-License-Identifier: GPL-2.0-or-later
// Water that flows from step to step: where the next one may begin, and what its length leaves out.
#include "core/terms/water/flow.hpp"

namespace gimpm {

template <int Dim> void Flow<Dim>::keepGrowth(const State& state) const
{
	water_.growth.clear();
	for (std::size_t n = 0; n < basis_.nodes.size(); ++n) {
		if (basis_.affineConstraints.contains(int(n))) continue;
		Eigen::Matrix<double, Dim + 1, 1> grown;
		grown << state.displacements().template segment<Dim>(Dim * n), state.growth(field)[n];
		water_.growth.emplace_hint(water_.growth.end(), basis_.nodes[n], grown);
	}
	water_.lastDuration = water_.duration;
}

template <int Dim> std::optional<FieldGrowth> Flow<Dim>::expected() const
{
	if (water_.lastDuration == 0) return std::nullopt;
	const auto   nodes = Eigen::Index(water_.growth.size());
	const double times = water_.duration / water_.lastDuration;
	FieldGrowth  all { {}, { Eigen::VectorXd(Dim * nodes), Eigen::VectorXd(nodes) } };
	for (const auto& [key, grown] : water_.growth) {
		const auto n                                 = Eigen::Index(all.nodes.size());
		all.values[0].template segment<Dim>(Dim * n) = times * grown.template head<Dim>();
		all.values[field][n]                         = times * grown[Dim];
		all.nodes.push_back(key);
	}
	return all;
}

/// Rates change from step to step as in rateChange(): T / (T_0 + T) of what differs from the last rates gone on. What
/// is elastic depends on how it got there, too, as water takes its time. Before the first step all was at rest, and
/// nodes that were not there have the rates of now.
template <int Dim> std::vector<LocalError> Flow<Dim>::fieldErrors(const State& state) const
{
	const bool      isFirst = water_.lastDuration == 0;
	const double    times   = isFirst ? 0 : water_.duration / water_.lastDuration;
	Eigen::VectorXd d = state.displacements(), p = state.growth(field);
	for (std::size_t n = 0; n < basis_.nodes.size() && !isFirst; ++n) {
		const auto last  = water_.growth.find(basis_.nodes[n]);
		const bool isNew = last == water_.growth.end();
		for (int a = 0; a < Dim; ++a)
			d[Dim * n + a] = isNew ? 0 : d[Dim * n + a] - times * last->second[a];
		p[n] = isNew ? 0 : p[n] - times * last->second[Dim];
	}
	constexpr int          order    = 2;
	const double           part     = isFirst ? 0.5 : water_.duration / (water_.lastDuration + water_.duration);
	const Eigen::VectorXd& now      = state.value(field);
	const int              own      = division_.ownOf(points_.size());
	double                 ofMotion = 0, ofPressure = 0, ofSaturation = 0, volume = 0;
	for (const auto& patch : basis_.patches)
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const PointFunctions<Dim> f(basis_, i, patch);
			Vec<Dim>                  moved   = Vec<Dim>::Zero();
			double                    pressed = 0, pressure = 0;
			if (basis_.order[i] >= own) continue;
			for (int n = 0; n < f.count; ++n)
				if (const int a = patch.node[n]; a >= 0) {
					moved += f.value[n] * d.template segment<Dim>(Dim * a);
					pressed += f.value[n] * p[a], pressure += f.value[n] * now[a];
				}
			const PorePoint& point = points_[basis_.order[i]];
			ofMotion += point.volume * moved.squaredNorm(), ofPressure += point.volume * pressed * pressed, volume += point.volume;
			if (!curves_) continue;
			const auto wetnessAt = [&](double at) { return saturationOf(*point.pores, at, point.ratio).value; };
			ofSaturation += point.volume * std::pow(wetnessAt(pressure) - wetnessAt(pressure - part * pressed), 2);
		}
	ofMotion = division_.sum(ofMotion), ofPressure = division_.sum(ofPressure), volume = division_.sum(volume);
	std::vector<LocalError> errors { { part * std::sqrt(ofMotion / volume), water_.displacementTolerance, order },
		                         { part * std::sqrt(ofPressure / volume), water_.pressureTolerance, order, "pressures", "Pa" } };
	if (curves_) errors.push_back({ std::sqrt(division_.sum(ofSaturation) / volume), water_.whole->saturationTolerance, order, "saturation", "(-)" });
	return errors;
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template std::optional<FieldGrowth> Flow<Dim>::expected() const;                                                                                       \
	template void                       Flow<Dim>::keepGrowth(const State&) const;                                                                         \
	template std::vector<LocalError>    Flow<Dim>::fieldErrors(const State&) const;
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
