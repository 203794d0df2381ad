// SPDX-License-Identifier: GPL-2.0-or-later
// Step 4 of the method: the growth of the fields at the nodes, first of all displacements, with which the step is in
// equilibrium.
#pragma once
#include "core/stepping/step_system.hpp"

namespace gimpm {

/// Newton's method from the prediction, if there is one (not empty); should it fail from there, it begins again at
/// zero. The solution is the same to the tolerance.
template <int Dim> Eigen::VectorXd equilibrium(const StepSystem<Dim>&, LinearSolver&, StepReport&, const Eigen::VectorXd& prediction);

} // namespace gimpm
