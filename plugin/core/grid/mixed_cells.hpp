// SPDX-License-Identifier: GPL-2.0-or-later
// Cells that hold several materials: there the interface is known to a cell only.
#pragma once
#include "core/grid/cloud_basis.hpp"

namespace gimpm {

/// Flags of cells that points of different materials populate, for each of basis.cells. `material` is in the order of
/// the cloud.
template <int Dim> std::vector<char> mixedCells(const CloudBasis<Dim>& basis, const std::vector<int>& material);

} // namespace gimpm
