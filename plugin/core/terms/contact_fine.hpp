// SPDX-License-Identifier: GPL-2.0-or-later
// Places on a ball that are closer to each other than on other bodies.
#pragma once
#include "core/terms/contact_surface.hpp"

namespace gimpm {

/// A ball of more than a cell touches with a few places; a quarter of a cell apart they take it along as the edges of a
/// polygon do.
template <int Dim> bool mayHaveFinePlaces(const RigidShape<Dim>& shape, double cellSize)
{
	return shape.kind == RigidKind::ball && shape.radius >= cellSize * (1 - 1e-9);
}

/// Where numbers of such places begin: they are told from those of the usual ones by that.
constexpr std::int64_t firstFineNumber = std::int64_t(1) << 40;

/// As surfacePointsAt, an eighth of a cell apart.
template <int Dim>
std::vector<SurfacePoint<Dim>> finePointsAt(const RigidShape<Dim>&, const Pose<Dim>&, double cellSize, const Vec<Dim>& low, const Vec<Dim>& high);

} // namespace gimpm
