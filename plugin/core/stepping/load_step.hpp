// SPDX-License-Identifier: GPL-2.0-or-later
// One load step of the ghost-stabilised implicit GIMPM (Coombs 2023, section 2).
#pragma once
#include "core/solvers/linear_solver.hpp"
#include "core/stepping/model.hpp"
#include "core/stepping/predictor.hpp"
#include "core/stepping/report.hpp"

namespace gimpm {

/// Advances the points to equilibrium under the load. If the step does not converge, the report says why and the points are unchanged.
/// The solver may be kept between steps to save symbolic analyses; the result does not depend on it. With `last` the step starts from a
/// prediction, and leaves its own displacements there for the next one.
template <int Dim> StepReport loadStep(PointCloud<Dim>&, const Model<Dim>&, const Load<Dim>&, LinearSolver&, LastIncrement<Dim>* last = nullptr);

/// Reduced tangent K + K_g (free degrees of freedom) of the current configuration.
template <int Dim> LinearProblem tangentStiffness(const PointCloud<Dim>&, const Model<Dim>&);

} // namespace gimpm
