// SPDX-License-Identifier: GPL-2.0-or-later
// From all nodal degrees of freedom to the free ones.
#pragma once
#include "core/fields/constraints.hpp"
#include "core/solvers/couplings.hpp"
#include "core/solvers/csc.hpp"
#include "core/solvers/node_matrix.hpp"

namespace gimpm {

/// Copies the pattern and the values of the free rows and columns of K, and of the couplings beside it: the lower
/// triangle, or both. With ties, of P^T K P, where P gives all nodes from those that are not tied. Couplings bring the
/// unknowns of other fields, which are scaled, and their rows' signs.
template <int Dim> void reduce(const NodeMatrix<Dim>& K, const FreeDofs&, SymmetricCsc& out, const Couplings* = nullptr);
template <int Dim> void reduce(const NodeMatrix<Dim>& K, const FreeDofs&, GeneralCsc& out, const Couplings* = nullptr);

} // namespace gimpm
