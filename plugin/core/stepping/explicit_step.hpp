// SPDX-License-Identifier: GPL-2.0-or-later
// One time step by central differences: no stiffness, no iteration.
#pragma once
#include "core/stepping/model.hpp"
#include "core/stepping/report.hpp"
#include "core/terms/inertia/motion.hpp"

namespace gimpm {

/// Advances points and motion by the duration of the motion. The model has no term for inertia. Forces are evaluated as
/// the step begins and at its end. Steps beyond the critical one (core/stepping/critical_step.hpp) are unstable;
/// whoever calls sees to it. If the step fails the report says why, and points and motion are unchanged.
template <int Dim> StepReport explicitStep(PointCloud<Dim>&, const Model<Dim>&, const Load<Dim>&, Motion<Dim>&);

} // namespace gimpm
