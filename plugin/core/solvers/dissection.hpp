// SPDX-License-Identifier: GPL-2.0-or-later
// Size of the factor of a matrix over nodes of a grid, in advance.
#pragma once
#include <array>
#include <vector>

namespace gimpm {

using NodePosition = std::array<int, 3>; ///< on the grid; the third 0 in the plane

/// True if Cholesky's method takes more operations than `flops` with nested dissection of the nodes: cut across their
/// longest axis, again and again, with a node coupled to those at most `reach` away along each axis. For a body with
/// few nodes to a cross section, as any in the plane, its box tells without them.
bool needsMoreFlops(std::vector<NodePosition>, double unknownsPerNode, double reach, double flops);

} // namespace gimpm
