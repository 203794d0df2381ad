// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/water/frozen_pressures.hpp"
#include "core/terms/water/flow_point.hpp"

namespace gimpm {

template <int Dim>
FrozenPressures<Dim>::FrozenPressures(const std::vector<double>& ofOwnPoints, const StepContext<Dim>& step, const std::vector<Vec<Dim>>& weights)
{
	auto pressures = ofOwnPoints;
	step.division.extend(pressures);
	force_ = absoluteContributions_ = Eigen::VectorXd::Zero(Dim * Eigen::Index(step.basis.nodes.size()));
	for (const auto& patch : step.basis.patches)
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const PointFunctions<Dim> f(step.basis, i, patch);
			const int                 p       = step.basis.order[i];
			const double              pushing = pressures[p] * step.cloud.volume0[p] * step.cloud.volumeRatio(p);
			for (int n = 0; n < f.count; ++n) {
				if (patch.node[n] < 0) continue;
				Vec<Dim> push = -pushing * f.gradient[n];
				push[0] -= pushing * f.hoop[n];
				if (!weights.empty()) push -= f.value[n] * weights[p];
				force_.template segment<Dim>(Dim * patch.node[n]) += push;
				absoluteContributions_.template segment<Dim>(Dim * patch.node[n]) += push.cwiseAbs();
			}
		}
}

template <int Dim> std::optional<PointFailure> FrozenPressures<Dim>::add(const Eigen::VectorXd&, const AssembledTerms<Dim>& sum)
{
	sum.force += force_;
	if (sum.absoluteContributions) *sum.absoluteContributions += absoluteContributions_;
	return std::nullopt;
}

template class FrozenPressures<2>;
template class FrozenPressures<3>;

} // namespace gimpm
