// SPDX-License-Identifier: GPL-2.0-or-later
// Small parts of a body that touches soil: edges, tips and borders.
#pragma once
#include "core/terms/contact/contact_system.hpp"
#include "core/terms/term.hpp"

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

/// Gives contact points on features of bodies that are small beside the cells wider functions. Soil that ends beside a
/// feature, as that under a plate does, is pressed evenly only by the functions of its cells: there all of the body
/// keeps these along that axis. Soil that goes on deeper down does not end, and behind the face there need not be any.
/// Around an axis of symmetry, where soil ends, and beside lines that part it nothing is spread, nor on a body that is
/// one with others that have contact points, as a facet of a mesh is.
template <int Dim> void widenDistributions(const std::vector<RigidBody<Dim>>&, const StepContext<Dim>&, std::vector<ContactPoint<Dim>>&);

} // namespace gimpm
