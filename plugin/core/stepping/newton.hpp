// SPDX-License-Identifier: GPL-2.0-or-later
// Step 4 of the method: Newton's method on the incremental nodal displacements.
#pragma once
#include "core/stepping/step_system.hpp"

namespace gimpm {

/// Finds d with external - internal(d) - K_g d = 0 on the free degrees of freedom, starting from d = 0; prescribed displacements enter
/// with the first solve. Converged when |residual| <= tolerance |external forces + reactions| (those at the start of the step, if they
/// were larger) or when it is zero to working precision, and when around each node at most three times the tolerance of the forces there is
/// left (LocalBalance). Fills the report's failure, iterations, residuals and worst degree of freedom.
///
/// A prediction (not empty) is the start unless its residual is more than twice that of zero; should the iteration fail from there, or its
/// first step not reduce the residual, it begins again at zero. The solution is the same to the tolerance.
template <int Dim>
Eigen::VectorXd equilibrium(const StepSystem<Dim>&, LinearSolver&, StepReport&, const Eigen::VectorXd& prediction);

} // namespace gimpm
