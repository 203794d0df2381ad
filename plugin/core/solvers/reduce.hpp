// SPDX-License-Identifier: GPL-2.0-or-later
// From all nodal degrees of freedom to the free ones.
#pragma once
#include "core/grid/ties.hpp"
#include "core/solvers/csc.hpp"
#include "core/solvers/node_matrix.hpp"

namespace gimpm {

/// The free degrees of freedom among Dim a node: number of each, rising, -1 for the held ones and those of tied nodes.
struct FreeDofs {
	std::vector<int> number;
	int              count = 0;
	const Ties*      ties  = nullptr; ///< null: there are none
};

/// Copies the pattern and the values of the free rows and columns of K: the lower triangle, or both. With ties, of P^T K P, where P gives all nodes from
/// those that are not tied.
template <int Dim> void reduce(const NodeMatrix<Dim>& K, const FreeDofs&, SymmetricCsc& out);
template <int Dim> void reduce(const NodeMatrix<Dim>& K, const FreeDofs&, GeneralCsc& out);

} // namespace gimpm
