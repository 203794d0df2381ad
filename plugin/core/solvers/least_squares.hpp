// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

namespace gimpm {

/// The shortest of all x for which |A x - b| is least, also where columns of A [rows x columns] depend on each other. Numbers that
/// are not finite where LAPACK refuses.
Eigen::VectorXd leastSquares(Eigen::MatrixXd A, const Eigen::VectorXd& b);

} // namespace gimpm
