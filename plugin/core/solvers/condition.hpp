// SPDX-License-Identifier: GPL-2.0-or-later
// Condition number of the linear system.
#pragma once
#include "core/solvers/linear_problem.hpp"

namespace gimpm {

/// 2-norm condition number, from all eigenvalues or singular values: for small systems. Above 1e14 it is round-off.
double conditionNumber(const LinearProblem&);

/// An estimate from below, within a few percent as a rule, from one factorisation and some dozens of solves and
/// products. It goes on to hold above 1e14 where only rows of different scale are the cause. Infinite for a matrix that
/// LinearSolver finds singular.
double conditionEstimate(const LinearProblem&);

} // namespace gimpm
