// SPDX-License-Identifier: GPL-2.0-or-later
// The end of a step: whether its displacements can be accepted, and what the points make of them.
#pragma once
#include "core/stepping/step_system.hpp"

namespace gimpm {

/// The displacements may lead where a term does not admit it. The report says so.
template <int Dim> void askForRefusals(const StepSystem<Dim>&, const Eigen::VectorXd& d, StepReport&);

/// An error above its tolerance makes the step fail. The report says so.
void testError(const LocalError&, StepReport&);

/// The same of what terms of several fields tell, after these have grown so much.
template <int Dim> void testFieldErrors(const StepSystem<Dim>&, const Eigen::VectorXd& growth, StepReport&);

/// Steps 5 and 6 of the method: the points take the displacements over, and the terms and walls what they remember;
/// reactions of what lies behind walls and of walls are added. If a point cannot be where it would be the report says
/// so, and nothing has changed.
template <int Dim> bool accept(const StepSystem<Dim>&, PointCloud<Dim>&, const Eigen::VectorXd& d, StepReport&);

} // namespace gimpm
