// SPDX-License-Identifier: GPL-2.0-or-later
// In which order the nodes of a grid are eliminated, so that a factor has few entries.
#pragma once
#include "core/solvers/dissection.hpp"

namespace gimpm {

/// Nodes, and which of them are coupled by an entry of the matrix.
struct NodeGraph {
	std::vector<NodePlace> places;
	std::vector<int>       start, neighbours; ///< those of node a: start[a] ... start[a + 1] - 1, without itself
};

/// Numbers of the nodes, the first to be eliminated first: by nested dissection (George, SIAM J. Numer. Anal. 10, 1973). The nodes are parted by a plane
/// across one of the axes; those beside it that are coupled to the other side come last, and each side is parted in turn.
std::vector<int> eliminationOrder(const NodeGraph&);

} // namespace gimpm
