// SPDX-License-Identifier: GPL-2.0-or-later
// Material points near rigid bodies when a step begins.
#pragma once
#include "core/grid/cloud_basis.hpp"
#include "core/grid/refinement.hpp"
#include "core/terms/contact/rigid_body.hpp"

namespace gimpm {

/// A material point near a body. A point keeps to the side of a two-sided surface where its centre is.
struct NearPoint {
	int body, point, side;
};

/// Points near each body: domains within h/2, and as much more as the body moves in the step, from it or inside of it,
/// and others by as much as soil moves. The time grows with the number of cells that the bodies reach.
template <int Dim>
std::vector<NearPoint> nearPoints(
        const std::vector<RigidBody<Dim>>&, const PointCloud<Dim>&, const CloudBasis<Dim>&, const Grid<Dim>&, double motionOfSoil = 0);

/// Largest motion of soil in a step for which it is searched near bodies [m].
template <int Dim> double reachOfSoil(const Grid<Dim>& grid) { return 0.5 * largestCell(grid); }

/// From the surface of a body [m].
template <int Dim> double searchReach(const RigidBody<Dim>& body, const Grid<Dim>& grid) { return reachOfSoil(grid) + body.motion(); }

} // namespace gimpm
