// SPDX-License-Identifier: GPL-2.0-or-later
// Cells that moving boundaries go through with the soil.
#pragma once
#include "core/grid/cloud_basis.hpp"
#include "core/parallel/division.hpp"

namespace gimpm {

/// The boundary of a step: told of the cells with centres of points beside its boxes that move (Boundary::setFilled).
template <int Dim> Boundary<Dim> amongSoil(const Boundary<Dim>&, const PointCloud<Dim>&, const Grid<Dim>&, Basis, const Division&);

} // namespace gimpm
