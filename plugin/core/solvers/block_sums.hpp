// SPDX-License-Identifier: GPL-2.0-or-later
// Reduced matrix of nodes that are tied, periodic or coupled: blocks come in any order, and several add up.
#pragma once
#include "core/fields/constraints.hpp"
#include "core/solvers/couplings.hpp"
#include "core/solvers/csc.hpp"
#include "core/solvers/node_matrix.hpp"

namespace gimpm {

/// The free rows and columns of P^T K P, where P gives all nodes from those that are not tied, and of the couplings.
/// The lower triangle, or both.
template <int Dim> void addUp(const NodeMatrix<Dim>& K, const FreeDofs&, const Couplings*, bool isTriangle, Csc& out);

} // namespace gimpm
