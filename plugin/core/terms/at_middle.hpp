// SPDX-License-Identifier: GPL-2.0-or-later
// The points' resistance in the middle of a step.
#pragma once
#include "core/terms/internal_force.hpp"

namespace gimpm {

/// Internal forces after half of the displacements: no torque acts on the points where angular momentum is looked at.
template <int Dim> class InternalForceAtMiddle : public InternalForce<Dim> {
public:
	using InternalForce<Dim>::InternalForce;

	/// To be added first.
	std::optional<PointFailure> add(const Eigen::VectorXd& d, const TermSum<Dim>& sum) const override
	{
		const auto failure = InternalForce<Dim>::add(0.5 * d, sum);
		if (sum.K) sum.K->multiplyBy(0.5);
		return failure;
	}
};

} // namespace gimpm
