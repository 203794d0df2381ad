// SPDX-License-Identifier: GPL-2.0-or-later
// What carries the parts of domains that reach behind walls.
#pragma once
#include "core/stepping/step_system.hpp"

namespace gimpm {

/// A domain that has outgrown a wall has a share in nodes behind it. They are left out of the system, which amounts to holding them in
/// place in all directions. Adds the forces that hold them to the reactions of the walls, so that reactions and loads are in balance.
/// A component along which a wall's own nodes are free goes to the box that makes the wall.
template <int Dim>
void addReactionsBeyondWalls(const StepSystem<Dim>&, const PointCloud<Dim>&, const Load<Dim>&, const Eigen::VectorXd& d, std::vector<Vec3>& reactions);

} // namespace gimpm
