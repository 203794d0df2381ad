// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

namespace gimpm {

/// The shortest of all X for which |A X - B| is least, column by column, also where columns of A depend on each other:
/// of the unit matrix the pseudoinverse of A. Numbers that are not finite where LAPACK refuses.
Eigen::MatrixXd leastSquares(Eigen::MatrixXd A, const Eigen::MatrixXd& B);

} // namespace gimpm
