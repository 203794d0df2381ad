// SPDX-License-Identifier: GPL-2.0-or-later
// A symmetric matrix as an iterative solver asks for it.
#pragma once
#include <Eigen/Core>

namespace gimpm {

/// Product with a symmetric matrix. Where several processes share it each has some rows, and those of vectors.
struct SymmetricOperator {
	virtual ~SymmetricOperator() = default;

	/// y = K x
	virtual void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const = 0;

	virtual Eigen::VectorXd diagonal() const = 0;

	/// |x| of all rows.
	virtual double norm(const Eigen::VectorXd& x) const { return x.stableNorm(); }

	/// Makes sums over the rows that are here those over all rows.
	virtual void complete(double* /*sums*/, int /*count*/) const { }
};

} // namespace gimpm
