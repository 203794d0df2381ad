// SPDX-License-Identifier: GPL-2.0-or-later
// A symmetric matrix over nodes in compressed rows, as multigrid is given it.
#pragma once
#include "core/solvers/reduce.hpp"
#include <optional>

namespace gimpm {

/// Rows of the nodes that are not held altogether, both triangles, by whole blocks. A held component has only its diagonal.
struct NodeRows {
	int                 dim;
	std::vector<int>    dof; ///< of each row, among Dim a node
	std::vector<int>    start, column;
	std::vector<double> value;
	struct Held {
		int    row;
		double diagonal;
	};
	std::vector<Held>   held;     ///< components
	std::vector<double> position; ///< of the nodes, in cells from their mean; empty on a periodic grid, where a body cannot rotate

	int rows() const { return int(dof.size()); }
};

/// Nothing if there are more entries than an int can count.
template <int Dim> std::optional<NodeRows> nodeRows(const NodeMatrix<Dim>&, const FreeDofs&);

} // namespace gimpm
