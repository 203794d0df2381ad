// SPDX-License-Identifier: GPL-2.0-or-later
// Cells in which the deformation varies too much for their size.
#pragma once
#include "core/grid/grid.hpp"
#include <vector>

namespace gimpm {

/// Centre, volume and deformation gradient of a point.
template <int Dim> struct DeformedVolume {
	Vec<Dim> position;
	double   volume;
	Mat3     deformationGradient;
};

/// Cells of a grid of equal ones in which the estimated error of the deformation gradient F is largest. As
/// O.C. Zienkiewicz and J.Z. Zhu (1987) do for stresses, it is the difference from a smooth field, which is bilinear
/// between means F_n at the nodes:
///
///     F_n = sum_p N_n(x_p) V_p F_p / sum_p N_n(x_p) V_p,  e_cell^2 = sum_p V_p |F_p - sum_n N_n(x_p) F_n|^2.
///
/// The cells found have 98 % of the sum of e_cell^2 (W. Dörfler 1996), with as few cells as that takes. Unlike the
/// stress, F still tells where soil shears when all of it yields. No cell is found where the error is below 5 % of
/// |F - I| of the whole: a body at rest under its weight needs no small cells.
template <int Dim> std::vector<Index<Dim>> varyingCells(const std::vector<DeformedVolume<Dim>>&, const Grid<Dim>&);

} // namespace gimpm
