// SPDX-License-Identifier: GPL-2.0-or-later
// A matrix of several fields in compressed rows, as processes share it and as multigrid is given it.
#pragma once
#include "core/solvers/node_rows.hpp"

namespace gimpm {

/// Rows like those of nodeRows(): node after node with the unknowns of all fields, which are scaled. Processes that
/// share the matrix all call it.
/// Multigrid is made for each field by itself, from `symmetricPart`: within a field (K + K^T) / 2, and between fields
/// K. The diagonal of fields besides the displacements gets what these leave of a field that they are eliminated from:
/// of C - B K^-1 A, where A and B lie between a field and the displacements, the part B K^-1 A, as a diagonal.
template <int Dim> std::optional<NodeRows> fieldRows(const NodeMatrix<Dim>&, const FreeDofs&, const OwnedNodes&, const Couplings&);

} // namespace gimpm
