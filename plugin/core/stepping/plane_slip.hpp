// SPDX-License-Identifier: GPL-2.0-or-later
// Stability of a free, steep face by limit analysis: slips along planes.
#pragma once
#include "core/grid/boundary.hpp"
#include "core/grid/point_cloud.hpp"
#include <optional>

namespace gimpm {

/// Strength by Mohr and Coulomb's law.
struct Strength {
	double cohesion = 0, frictionAngle = 0; ///< [Pa], [rad]
};

/// Soil beside a free face, above a plane that rises from its foot.
template <int Dim> struct PlaneSlip {
	Vec<Dim> foot;       ///< foot of the face [m]
	int      axis;       ///< across the face
	double   height = 0; ///< height of the face [m]
	double   angle  = 0; ///< angle of the plane with the horizontal [rad]
	double   excess = 0; ///< work of the weight over what the cohesion on the plane can dissipate; infinite without cohesion
};

/// The slip with the largest excess (Coulomb 1776): the soil above the plane moves as a block, at the angle of friction
/// with the plane. Where the excess is above one nothing can be in equilibrium (upper bound theorem, Drucker, Prager
/// and Greenberg 1952), whatever the dilation is, with which soil bears no more than with that of the theorem
/// (Radenkovic 1961). Left out, so that it is a bound from above: faces lower than nine tenths of a cell, blocks with
/// constrained nodes, with cavities or with other materials in them, and in space faces that do not go all across the
/// body.
///
/// `strength`: by material, nothing of those that have another law; where points differ, the largest of all. `weight`:
/// of each point [N]. `down`: of gravity, a unit vector along an axis.
template <int Dim>
std::optional<PlaneSlip<Dim>> worstPlaneSlip(
        const PointCloud<Dim>&, const Grid<Dim>&, const Boundary<Dim>&, const std::vector<std::optional<Strength>>& strength, const std::vector<double>& weight,
        const Vec<Dim>& down);

} // namespace gimpm
