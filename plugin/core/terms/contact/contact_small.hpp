// SPDX-License-Identifier: GPL-2.0-or-later
// Small parts of a body that touches soil: edges, tips and borders.
#pragma once
#include "core/terms/contact/rigid_body.hpp"
#include <vector>

namespace gimpm {

/// A contact point where soil is before a body, and the normal of its face, unit.
template <int Dim> struct FacePoint {
	Vec<Dim> position, normal;
};

/// Distances of contact points from the edge between faces that have soil before them [m]; infinite if the faces do not
/// meet in one.
template <int Dim> double reachFromEdge(const RigidBody<Dim>& block, const Pose<Dim>&, const std::vector<FacePoint<Dim>>&);

/// The same of the border of a sheet.
template <int Dim> double reachFromBorder(const RigidBody<Dim>& sheet, const Pose<Dim>&, const std::vector<FacePoint<Dim>>&);

} // namespace gimpm
