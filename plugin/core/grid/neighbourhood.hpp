// SPDX-License-Identifier: GPL-2.0-or-later
// Processes that need a point, of those that have divided the cells.
#pragma once
#include "core/grid/basis.hpp"
#include "core/grid/grid.hpp"
#include "core/grid/point_cloud.hpp"
#include "core/parallel/division.hpp"

namespace gimpm {

/// The lowest cell of a layer that a domain reaches, in a periodic grid the one that stands for it.
template <int Dim> Key lowestCell(const Vec<Dim>& position, const Vec<Dim>& halfSize, const Grid<Dim>&, Basis, int layer = 0);

/// The processes that need a point with this lowest cell: those that have a node which it may reach, and, where others
/// need to know all points of their cells (`isWide`), one that is a cell further. Rising.
template <int Dim> std::vector<int> neededBy(const Division&, Key lowest, const Grid<Dim>&, bool isWide);

/// The points of this process that each of the others needs, by their positions in the cloud (Division::lent).
template <int Dim> std::vector<std::vector<int>> neededPoints(const PointCloud<Dim>&, const Division&, const Grid<Dim>&, Basis, bool isWide);

} // namespace gimpm
