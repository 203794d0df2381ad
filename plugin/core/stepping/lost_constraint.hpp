// SPDX-License-Identifier: GPL-2.0-or-later
// Check that the boxes that move nodes have not lost the soil.
#pragma once
#include "core/grid/cloud_basis.hpp"
#include "core/stepping/model.hpp"
#include <string>

namespace gimpm {

/// Nodes stay where they are while the soil that they push moves on. What is wrong with the first box found that is to
/// move and holds no node with soil, or whose soil has gone more than half a cell away in front of a node; or empty. It
/// depends on the present state only.
template <int Dim> std::string lostConstraint(const PointCloud<Dim>&, const CloudBasis<Dim>&, const Model<Dim>&, const Load<Dim>&);

/// A box of the boundary that reaches soil in a refined grid and holds nothing, because it lies between the nodes. One
/// clause, or empty.
template <int Dim> std::string boxBetweenNodes(const CloudBasis<Dim>&, const Boundary<Dim>&);

} // namespace gimpm
