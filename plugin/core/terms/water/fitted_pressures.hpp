// SPDX-License-Identifier: GPL-2.0-or-later
// Pressures of points at nodes that have none yet.
#pragma once
#include "core/grid/cloud_basis.hpp"

namespace gimpm {

/// Linear function at each node that fits the pressures of the points around it best, weighted by functions and
/// volumes; where these do not tell its gradient, that of the points around its neighbours, too. Linear pressures are
/// exact at any cut of the cells. All points are known, and cells are equal.
template <int Dim> Eigen::VectorXd fittedPressures(const CloudBasis<Dim>&, const PointCloud<Dim>&, const Grid<Dim>&, const std::vector<double>& pressure);

} // namespace gimpm
