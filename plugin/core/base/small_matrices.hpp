// SPDX-License-Identifier: GPL-2.0-or-later
// Small matrix problems by LAPACK: Eigen's templates for the same take the compiler seconds for each size of matrix.
#pragma once
#include <Eigen/Core>

namespace gimpm {

struct SymmetricEigen {
	Eigen::VectorXd values; ///< the smallest first
	Eigen::MatrixXd vectors;
};

/// Eigenvalues and unit eigenvectors. Numbers that are not finite where LAPACK refuses.
SymmetricEigen symmetricEigen(Eigen::MatrixXd symmetric);

/// X of A X = B, numbers that are not finite where A is singular.
Eigen::MatrixXd solutionOf(Eigen::MatrixXd A, Eigen::MatrixXd B);

/// True for a positive definite symmetric matrix; false if it has numbers that are not finite.
bool isPositiveDefinite(Eigen::MatrixXd symmetric);

} // namespace gimpm
