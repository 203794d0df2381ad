// SPDX-License-Identifier: GPL-2.0-or-later
// The iterative way through step 4 where the matrix is not symmetric.
#pragma once
#include "core/solvers/csc.hpp"

namespace gimpm {

/// K x = b to |b - K x| <= tolerance |b|, by restarted GMRES preconditioned with an incomplete LU factor of K's own
/// pattern, or with the diagonal first, as long as that gains enough; `iterations` grows by those made. False, with x
/// meaningless, if there is no such factor or if it takes too long. A singular K is not told from a regular one if b
/// lies in its range.
bool gmres(const GeneralCsc& K, const Eigen::VectorXd& b, double tolerance, Eigen::VectorXd& x, int& iterations, bool diagonalFirst);

} // namespace gimpm
