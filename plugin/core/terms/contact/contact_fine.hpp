// SPDX-License-Identifier: GPL-2.0-or-later
// Contact points on a ball that are closer to each other than on other bodies.
#pragma once
#include "core/terms/contact/contact_surface.hpp"

namespace gimpm {

/// A ball of two cells and more may touch with few contact points; a quarter of a cell apart they take it along as the
/// edges of a polygon do. Soil that smaller ones meet is not resolved.
template <int Dim> bool mayHaveFinePoints(const RigidShape<Dim>& shape, double cellSize)
{
	return shape.kind == RigidKind::ball && shape.radius >= cellSize * (2 - 1e-9);
}

/// First number of fine contact points, by which they differ from the usual ones.
constexpr std::int64_t firstFineNumber = std::int64_t(1) << 40;

/// Surface points as in surfacePointsAt, an eighth of a cell apart.
template <int Dim>
std::vector<SurfacePoint<Dim>> finePointsAt(const RigidShape<Dim>&, const Pose<Dim>&, double cellSize, const Vec<Dim>& low, const Vec<Dim>& high);

} // namespace gimpm
