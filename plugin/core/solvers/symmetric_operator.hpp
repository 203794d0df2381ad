// SPDX-License-Identifier: GPL-2.0-or-later
// A symmetric matrix as an iterative solver asks for it.
#pragma once
#include <Eigen/Core>

namespace gimpm {

struct SymmetricOperator {
	virtual ~SymmetricOperator() = default;

	/// y = K x
	virtual void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const = 0;

	virtual Eigen::VectorXd diagonal() const = 0;
};

} // namespace gimpm
