// SPDX-License-Identifier: GPL-2.0-or-later
// Water in pores that need not be full, from step to step.
#include "core/terms/water/flow.hpp"

namespace gimpm {

/// Gives nodes the content that their points have more or less than these say, as points have moved on the grid.
template <int Dim> void Flow<Dim>::beginUnsaturated(const Eigen::VectorXd& P)
{
	auto known = water_.whole->saturation;
	division_.extend(known);
	curves_.emplace(points_, basis_);
	before_ = curves_->at(P);
	correction_.assign(points_.size(), 0);
	for (const auto& patch : basis_.patches)
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const PointFunctions<Dim> f(basis_, i, patch);
			const int                 p          = basis_.order[i];
			double                    saturation = 0;
			const auto* const         shared     = curves_->of(p, before_);
			for (int n = 0; n < f.count; ++n) {
				const int a = patch.node[n];
				if (a < 0) continue;
				saturation += f.value[n] * (shared ? (*shared)[a].saturation : saturationOf(*points_[p].pores, P[a], points_[p].ratio)).value;
			}
			if (!known.empty() && !std::isnan(known[p])) correction_[p] = (known[p] - saturation) * points_[p].content;
		}
}

template <int Dim> void Flow<Dim>::commitSaturation(const State& state)
{
	const Eigen::VectorXd P       = state.value(field);
	const auto            wetness = curves_->at(P);
	double                stored  = 0;
	const int             own     = division_.ownOf(points_.size());
	water_.whole->saturation.resize(own), water_.whole->push.resize(own);
	for (const auto& patch : basis_.patches)
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const int                 p = basis_.order[i];
			const PointFunctions<Dim> f(basis_, i, patch);
			if (p >= own) continue;
			const FlowPoint<Dim>        s(points_[p], patch, f, state.displacements(), P, water_.modulus);
			const UnsaturatedPoint<Dim> u = unsaturated(p, patch, f, s, wetness);
			for (int n = 0; n < f.count; ++n)
				stored += points_[p].volume / points_[p].ratio * f.value[n] * u.stored[n];
			water_.whole->saturation[p] = u.content / u.filled;
			water_.whole->push[p]       = u.push.value;
			water_.flux[p]              = -s.kappa.value * u.permeability * conducted(*points_[p].pores, water_.vertical, u.drive);
		}
	water_.stored = division_.sum(stored);
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template void Flow<Dim>::beginUnsaturated(const Eigen::VectorXd&);                                                                                     \
	template void Flow<Dim>::commitSaturation(const State&);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
