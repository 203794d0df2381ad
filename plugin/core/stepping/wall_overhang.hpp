// SPDX-License-Identifier: GPL-2.0-or-later
// Forces on the parts of domains that reach behind walls.
#pragma once
#include "core/stepping/step_system.hpp"
#include "core/terms/inertia/motion.hpp"

namespace gimpm {

/// A domain that has outgrown a wall has a share in nodes behind it. They are left out of the system, which amounts to
/// holding them in place in all directions. Adds the forces that hold them to the reactions of the walls, so that
/// reactions and loads are in balance. A component along which a wall's own nodes are free goes to the box that makes
/// the wall, or to the open box.
template <int Dim> void addReactionsBeyondWalls(const StepSystem<Dim>&, const Eigen::VectorXd& d, StepReport&);

/// A domain moves by averages over all of it, of which the part behind a wall counts as still: a centre that is carried
/// to the wall could pass it, and would be alone behind it. One that has moved so since `before` moves by the functions
/// of its position instead, which at the wall are those of constrained nodes.
template <int Dim> void keepBeforeWalls(PointCloud<Dim>&, const PointCloud<Dim>& before, const StepSystem<Dim>&, const Eigen::VectorXd& d);

/// Adds the forces of their inertia in a time step to the reactions, when the motion has taken it over.
template <int Dim> void addInertiaBeyondWalls(const StepSystem<Dim>&, const Motion<Dim>&, StepReport&);

} // namespace gimpm
