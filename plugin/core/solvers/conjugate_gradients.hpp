// SPDX-License-Identifier: GPL-2.0-or-later
// The iterative way through step 4, for bodies whose Cholesky factor is too large: conjugate gradients, preconditioned with the diagonal.
#pragma once
#include "core/solvers/symmetric_operator.hpp"

namespace gimpm {

/// K x = b to |b - K x| <= tolerance |b|; `iterations` grows by those made. False, with x meaningless, if K shows itself not positive definite (a
/// direction of negative curvature) or if that takes too long. A singular K is not told from a regular one if b lies in its range. The result does
/// not depend on the number of threads.
bool conjugateGradients(const SymmetricOperator& K, const Eigen::VectorXd& b, double tolerance, Eigen::VectorXd& x, int& iterations);

} // namespace gimpm
