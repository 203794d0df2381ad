// SPDX-License-Identifier: GPL-2.0-or-later
// Surfaces of facets in space that part the soil on their two sides.
#pragma once
#include "core/grid/parting.hpp"
#include "core/grid/point_cloud.hpp"
#include <array>
#include <vector>

namespace gimpm {

/// A surface in space that parts the soil on its two sides, or might. No more than two facets share an edge, and they
/// run round the same way; the left side is that of their normals (p1 - p0) x (p2 - p0).
struct PartingSheet {
	std::vector<Vec3>               positions; ///< of the vertices, as the step begins [m]
	std::vector<std::array<int, 3>> facets;
	/// Flags of the edges of each facet, from its corner 0 to 1, 1 to 2 and 2 to 0: no other facet shares them.
	std::vector<std::array<bool, 3>>   isBorder;
	std::vector<std::pair<Vec3, Vec3>> boxes; ///< around the facets [m]

	/// In this step: of the points to its right, where it parts the soil; 0: it does not.
	int layer = 0;
	/// In this step: it has soil on both of its sides, and parts it or does not.
	bool isBetween = false;

	/// Sets what follows from the facets.
	void prepare();
};

/// The side of a surface that a position is on: > 0 left, < 0 right. The distances from the planes of the facets that
/// are nearest to it, weighted by their angles there [m].
double sideOf(const PartingSheet&, const Vec3& position);

/// Gives, as partSoil() of lines does, points to the right of sheets, near these, layers of their own, the grid the
/// nodes there that are there twice, and sheets the layer of the soil to their right; 0 where there is soil on one side
/// only. An edge that has soil beyond it, and is not at another sheet, is the edge of a cut, around which soil is
/// whole: as of the nodes next to it.
void partSoil(const std::vector<PartingSheet*>&, PointCloud<3>&, Grid<3>&, bool mayBeNear = false);

/// Distance of a position from a sheet [m]; the side of it that it is on, as sideOf().
double awayFrom(const PartingSheet&, const Vec3& position);
double sideFrom(const PartingSheet&, const Vec3& position);

/// Middles of the facets and of the edges of a sheet; true if a position is within a reach of a sheet, and not of its
/// edges.
std::vector<Vec3> middlesOf(const PartingSheet&);
std::vector<Vec3> endsOf(const PartingSheet&);
bool              isAtMiddle(const PartingSheet&, const Vec3& position, double reach);

/// Finds the sheets that have soil on both of their sides; no more, where none may part it.
void lookBetween(const std::vector<PartingSheet*>&, const PointCloud<3>&, const Grid<3>&);

} // namespace gimpm
