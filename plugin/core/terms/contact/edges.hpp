// SPDX-License-Identifier: GPL-2.0-or-later
// Edges and tips of rigid bodies, where the pressure on them is singular, and surfaces of round ones.
#pragma once
#include "core/terms/contact/rigid_body.hpp"
#include <vector>

namespace gimpm {

/// Positions on edges and tips, and on the whole surface of balls and capsules, no farther apart than the spacing, with
/// the bodies at their poses `begin`. Sheets that share an edge have none there unless they turn by more than 20
/// degrees; planes have none. Around an axis of symmetry the other half of a section is its mirror image.
template <int Dim> std::vector<Vec<Dim>> edgesOf(const std::vector<RigidBody<Dim>>&, double spacing, bool isAxisymmetric);

} // namespace gimpm
