// SPDX-License-Identifier: GPL-2.0-or-later
// In which order the nodes of a grid are eliminated, so that a factor has few entries.
#pragma once
#include "core/solvers/dissection.hpp"

namespace gimpm {

/// Nodes, and which of them are coupled by an entry of the matrix.
struct NodeGraph {
	std::vector<NodePosition> positions;
	std::vector<int>          start, neighbours; ///< those of node a: start[a] ... start[a + 1] - 1, without itself
};

/// Numbers, the first to be eliminated first. Some of them, and some that follow, are two parts which are not coupled
/// to each other; what is left separates them.
struct Order {
	std::vector<int> numbers;
	int              first = 0, second = 0; ///< numbers of nodes in the parts
};

/// Order of the nodes by nested dissection (George, SIAM J. Numer. Anal. 10, 1973): they are parted by a plane across
/// one of the axes; those beside it that are coupled to the other side come last, and each side is parted in turn.
Order eliminationOrder(const NodeGraph&);

} // namespace gimpm
