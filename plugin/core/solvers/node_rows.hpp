// SPDX-License-Identifier: GPL-2.0-or-later
// A matrix over nodes in compressed rows, as multigrid is given it: all rows, or those of one of several processes.
#pragma once
#include "core/parallel/owned_nodes.hpp"
#include "core/solvers/reduce.hpp"
#include <optional>
#include <string>

namespace gimpm {

/// Rows of the nodes that are not held altogether, both triangles, by whole blocks. A constrained component has only
/// its diagonal.
struct NodeRows {
	int                 dim;   ///< unknowns a node
	int                 all;   ///< rows, of all processes
	int                 first; ///< number of the first one here among them
	std::vector<int>    dof;   ///< degree of freedom of each row, among all unknowns
	std::vector<int>    start, column;
	std::vector<double> value;
	/// Values of (K + K^T) / 2, in the same positions; empty where K is symmetric. For several fields see
	/// fieldRows().
	std::vector<double> symmetricPart;
	struct Held {
		int    row;
		double diagonal;
	};
	std::vector<Held>   held;      ///< components
	std::vector<double> position;  ///< positions of the nodes, in cells from their mean; empty on a periodic grid, where a body cannot rotate
	std::vector<int>    columnDof; ///< degree of freedom of each column, among all unknowns
	std::vector<int>    widths;    ///< unknowns a node of each field

	int rows() const { return int(dof.size()); }
};

/// Nothing if there are more entries than an int can count. Those of this process.
template <int Dim> std::optional<NodeRows> nodeRows(const NodeMatrix<Dim>&, const FreeDofs&, const OwnedNodes&, const Couplings* = nullptr);

/// Why a library cannot be given the rows, of several processes all of them; empty if it can. `hasPositions`: whether
/// there are any, which a process without rows hears from the others.
std::string obstacleTo(const std::optional<NodeRows>&, const OwnedNodes&, bool& hasPositions);

/// Numbers of rows, also where this process has none and others have some.
inline const double* numbersOf(const std::vector<double>& numbers, bool areThere)
{
	static const double none = 0;
	return !areThere ? nullptr : numbers.empty() ? &none : numbers.data();
}

} // namespace gimpm
