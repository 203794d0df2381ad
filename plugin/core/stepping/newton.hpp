// SPDX-License-Identifier: GPL-2.0-or-later
// Newton's method on the growth of the fields at the nodes in a step, first of all displacements.
#pragma once
#include "core/solvers/linear_solver.hpp"
#include "core/stepping/step_system.hpp"

namespace gimpm {

/// Returns the growth d, block by block, with r(d) = external - (sum of the terms at d) = 0 on the free degrees of
/// freedom: displacements have Dim components a node [m]. A prediction (not empty) is the start unless |r| is more
/// than twice that of zero there. Fills the report's failure, iterations, residuals, reactions, worst degree of
/// freedom and ratio of work, and tells whether the prediction was the start.
template <int Dim> Eigen::VectorXd newton(const StepSystem<Dim>&, LinearSolver&, StepReport&, const Eigen::VectorXd& prediction);

} // namespace gimpm
