// SPDX-License-Identifier: GPL-2.0-or-later
// The iterative way through step 4, for bodies whose Cholesky factor is too large.
#pragma once
#include "core/solvers/csc.hpp"

namespace gimpm {

/// K x = b to |b - K x| <= tolerance |b|, by conjugate gradients preconditioned with the diagonal of K; `iterations` grows by those made.
/// False, with x meaningless, if K shows itself not positive definite (a direction of negative curvature) or if that takes too long. A
/// singular K is not told from a regular one if b lies in its range.
bool conjugateGradients(const SymmetricCsc& K, const Eigen::VectorXd& b, double tolerance, Eigen::VectorXd& x, int& iterations);

} // namespace gimpm
