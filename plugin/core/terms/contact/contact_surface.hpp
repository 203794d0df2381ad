// SPDX-License-Identifier: GPL-2.0-or-later
// Points on the surfaces of rigid bodies, over which contact is integrated.
#pragma once
#include "core/terms/contact/rigid_body.hpp"
#include <array>
#include <cstdint>
#include <vector>

namespace gimpm {

/// A contact point on a body, in the body's axes, and the part of the surface around it that it stands for.
template <int Dim> struct SurfacePoint {
	std::int64_t number;           ///< its name as long as shape and spacing stay the same
	Vec<Dim>     position, normal; ///< the normal is that of its face, unit, out of the body
	double       area;             ///< [m2], in 2D per metre; around an axis of symmetry to be multiplied by the circumference
	Vec<Dim>     aside;            ///< along the face, from the contact point to where it acts on the soil

	/// Corners of that part, around it; of a triangle the last two are one.
	std::array<Vec<Dim>, 2 * (Dim - 1)> corners;
};

/// The number of parts into which the longest edge of a sheet or a capsule is divided, for points no farther apart than
/// the spacing.
int partsOfEdge(RigidKind, double length, double spacing);

/// Points no farther apart than the spacing, at least two along each edge, in mirror symmetry to the centre of a ball
/// or a block: those within a box in the body's axes. A two-sided surface has points on both sides. A block's face that
/// is narrower than a cell, four spacings, acts on the soil over the width of one: a single node of the grid gives way
/// more easily than two, and what a narrower face meets would depend on where it stands among them.
template <int Dim> std::vector<SurfacePoint<Dim>> surfacePoints(const RigidShape<Dim>&, double spacing, const Vec<Dim>& low, const Vec<Dim>& high);

/// A ball of two cells and more may touch with few contact points; a quarter of a cell apart they take it along as the
/// edges of a polygon do, and so it may have fine ones. Soil that smaller ones meet is not resolved.
template <int Dim> bool mayHaveFinePoints(const RigidShape<Dim>& shape, double cellSize)
{
	return shape.kind == RigidKind::ball && shape.radius >= cellSize * (2 - 1e-9);
}

/// First number of fine contact points, by which they differ from the usual ones.
constexpr std::int64_t firstFineNumber = std::int64_t(1) << 40;

/// Those of contact on a grid with cells of this size, on a body at a pose: within a box in the axes of space. A
/// quarter of a cell apart, fine ones an eighth.
template <int Dim>
std::vector<SurfacePoint<Dim>> surfacePointsAt(
        const RigidShape<Dim>&, const Pose<Dim>&, double cellSize, const Vec<Dim>& low, const Vec<Dim>& high, bool isFine = false);

} // namespace gimpm
