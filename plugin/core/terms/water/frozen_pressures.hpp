// SPDX-License-Identifier: GPL-2.0-or-later
// Water that flows, as it is at one moment.
#pragma once
#include "core/terms/term.hpp"

namespace gimpm {

/// The pressures of all points, of which each process gives those of its own, as forces on the soil that stay as they
/// are: what is left of the flow at one moment. Water that points have more than when they were full may have weight.
template <int Dim> class FrozenPressures : public Term<Dim> {
public:
	FrozenPressures(const std::vector<double>& ofOwnPoints, const StepContext<Dim>&, const std::vector<Vec<Dim>>& weights = {});

	void                        mark(NodeMatrix<Dim>&) const override { }
	std::optional<PointFailure> add(const Eigen::VectorXd& d, const AssembledTerms<Dim>&) override;

private:
	Eigen::VectorXd force_, absoluteContributions_;
};

} // namespace gimpm
