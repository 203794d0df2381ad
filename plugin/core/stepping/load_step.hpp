// SPDX-License-Identifier: GPL-2.0-or-later
// One load step of the ghost-stabilised implicit GIMPM (Coombs 2023, section 2).
#pragma once
#include "core/solvers/linear_solver.hpp"
#include "core/stepping/model.hpp"
#include "core/stepping/predictor.hpp"
#include "core/stepping/report.hpp"

namespace gimpm {

/// Advances the points to equilibrium under the load. If the step does not converge, the report says why and the points
/// are unchanged. The solver may be kept between steps to save symbolic analyses; the result does not depend on it.
/// With `last` the step starts from a prediction, and leaves its own displacements there for the next one.
template <int Dim> StepReport loadStep(PointCloud<Dim>&, const Model<Dim>&, const Load<Dim>&, LinearSolver&, LastIncrement<Dim>* last = nullptr);

/// Reduced tangent (free degrees of freedom) of all terms in the current configuration: that of the first iteration of
/// a step from there. Where a term cannot act the matrix is empty, and the report, if there is one, says why.
template <int Dim> LinearProblem tangentStiffness(const PointCloud<Dim>&, const Model<Dim>&, StepReport* = nullptr);

} // namespace gimpm
