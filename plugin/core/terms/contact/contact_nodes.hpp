// SPDX-License-Identifier: GPL-2.0-or-later
// A body that deforms with nodes at its corners, as a member of a net or a membrane: who takes which part of a force.
#pragma once
#include "core/terms/contact/contact_system.hpp"

namespace gimpm {

/// Barycentric coordinates of the contact point of the body that is closest to one in its axes, as it is at the
/// beginning of the step: of a sheet in its plane, also beyond its edges, of a capsule on its axis.
template <int Dim> std::array<double, 3> nodeWeights(const RigidBody<Dim>&, const Vec<Dim>& own);

/// A force on the surface of a body with nodes.
struct ForceOnNodes {
	Vec3   force, position; ///< [N]; at the end of the step [m]
	Mat3   resists;         ///< stiffness of what exerts it [N/m]
	double area, modulus;   ///< area of the surface that acts on it [m2]; Young's modulus of the soil [Pa]
};

/// Distributes a contact force to the nodes of a body: the force by the weights, and the moment about the contact point
/// with these weights by a couple of forces of the least size; what turns a capsule about its axis, by torques. So
/// forces and moments about any point add up to that of the force itself. The stiffness is a diagonal that bounds that
/// of all nodes, as the weights add up to one. `soil`: the contact point at the beginning of the step.
std::array<ContactLoad, 3> loadsOnNodes(const RigidBody<3>&, const Vec3& soil, const ForceOnNodes&);

} // namespace gimpm
