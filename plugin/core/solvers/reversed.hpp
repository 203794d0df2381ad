// SPDX-License-Identifier: GPL-2.0-or-later
// Matrices as direct solvers are given them: rows and columns in the opposite order, and scaled.
#pragma once
#include "core/solvers/csc.hpp"

namespace gimpm {

inline Eigen::VectorXd reversed(const Eigen::VectorXd& x) { return x.reverse(); }

/// Pattern of the matrix with rows and columns in the opposite order. A lower triangle has become the upper one, which
/// CHOLMOD factorises with one transposition less.
void reverse(const Csc& K, Csc& reversed);
bool isReverse(const Csc& K, const Csc& reversed);

/// Copies the values of K in the opposite order, with rows and columns scaled by powers of two that bring the diagonal
/// close to one, and returns those of K. This is exact, and lets pivots be judged: a node that the body hardly touches
/// has a small diagonal and is not singular for that.
Eigen::VectorXd scale(const Csc& K, std::vector<double>& scaled);

/// Zero where there is none.
double diagonalOf(const Csc& K, int column);

} // namespace gimpm
