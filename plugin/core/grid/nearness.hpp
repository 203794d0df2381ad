// SPDX-License-Identifier: GPL-2.0-or-later
// Nearness of positions to the domains of the points.
#pragma once
#include "core/grid/grid.hpp"
#include "core/grid/point_cloud.hpp"

namespace gimpm {

/// Flags of positions: 1 if no domain of a layer (-1: of any) is as near along each axis, else 0. No reach may be more
/// than half of the largest cells.
template <int Dim>
std::vector<std::int64_t> areFarFromMaterial(
        const std::vector<Vec<Dim>>& positions, const std::vector<double>& reach, const PointCloud<Dim>&, const Grid<Dim>&, int layer = -1);

} // namespace gimpm
