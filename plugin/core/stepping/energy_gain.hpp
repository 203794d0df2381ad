// SPDX-License-Identifier: GPL-2.0-or-later
// Energy that a time step makes of nothing.
#pragma once
#include "core/stepping/step_system.hpp"

namespace gimpm {

/// True if a time step, by these displacements, has not ended in an equilibrium far from the motion, with spurious
/// energy gain; the report says so if it has. The midpoint rule takes its stress elsewhere, and has not been seen to.
/// MPM bodies in contact are admitted a thousandth of what is in play: a blow within one step leaves accelerations to
/// the points that the grid of the next one is not in balance with. Beside that, what loads work in the step, which
/// schemes that weigh it over the step know no better as a body begins to move; where displacements are prescribed
/// nothing is asked.
template <int Dim>
bool requireEnergy(const StepSystem<Dim>&, const PointCloud<Dim>& before, const PointCloud<Dim>& after, const Eigen::VectorXd& d, StepReport&);

} // namespace gimpm
