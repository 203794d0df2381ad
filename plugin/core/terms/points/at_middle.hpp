// SPDX-License-Identifier: GPL-2.0-or-later
// The points' resistance in the middle of a step.
#pragma once
#include "core/terms/points/internal_force.hpp"

namespace gimpm {

/// Internal forces after half of the displacements: no torque acts on the points where angular momentum is looked at.
template <int Dim> class InternalForceAtMiddle : public InternalForce<Dim> {
public:
	using InternalForce<Dim>::InternalForce;

	std::optional<PointFailure> add(const Eigen::VectorXd& d, const AssembledTerms<Dim>& sum) override
	{
		// So that half of the sum leaves to others what is theirs, to the last bit.
		if (sum.K) sum.K->multiplyBy(2);
		const auto failure = InternalForce<Dim>::add(0.5 * d, sum, 0.5);
		if (sum.K) sum.K->multiplyBy(0.5);
		return failure;
	}
};

} // namespace gimpm
