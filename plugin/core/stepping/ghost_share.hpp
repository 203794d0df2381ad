// SPDX-License-Identifier: GPL-2.0-or-later
// Part of the work in a static step that the ghost stabilisation takes.
#pragma once
#include "core/stepping/step_system.hpp"

namespace gimpm {

/// Forces of the stabilisation below this part of the largest nodal force from outside are none: where hardly anything
/// moves, as in a step of rest, they may be most of what little work there is.
constexpr double leastGhostForce = 0.02;

/// Part of the work at the nodes of its faces that the stabilisation takes up when the nodes go to d, 0 to 1 [-]:
/// |d . g| / (|d . g| + sum over their unknowns of |d p|), with its forces g and those p of the points' stress.
/// NaN of time steps, where inertia bears what is out of balance, and of several fields.
///
/// `force`: the sum of the terms at d [N].
template <int Dim> double ghostShare(const StepSystem<Dim>&, const Eigen::VectorXd& d, const Eigen::VectorXd& force);

} // namespace gimpm
