// SPDX-License-Identifier: GPL-2.0-or-later
// Error of displacements by the length of a quasi-static step.
#pragma once
#include "core/stepping/predictor.hpp"
#include "core/stepping/step_system.hpp"

namespace gimpm {

/// Rates change from the step before to this one by v - v_0, and within a step as fast, so that the displacements d = T
/// v are off by
///
///     T^2 / (T_0 + T) |v - v_0| = T / (T_0 + T) |d - prediction|
///
/// (the pair of Euler's backward and the trapezoidal rule: Sloan and Abbo 1999, "Biot consolidation analysis with
/// automatic time stepping and error control"), with growths T of the load for times. Here it is the root of the mean
/// square over the points, by volume. What deforms elastically does not depend on how it got there: the error is that
/// times the share of plastic strain in the strain of the step, and zero without plastic strain. The prediction is that
/// of `last` for this step, and not empty.
template <int Dim>
LocalError rateChange(const StepSystem<Dim>&, const LastIncrement<Dim>& last, double load, const Eigen::VectorXd& prediction, const Eigen::VectorXd& d);

} // namespace gimpm
