// SPDX-License-Identifier: GPL-2.0-or-later
// Softening that does not depend on the size of cells: strength goes with m mean + (1 - m) own plastic strain, m = 2
// (over-nonlocal, Vermeer and Brinkgreve 1994), where the mean solves mean - l^2 laplacian(mean) = own on the
// background grid (Peerlings et al. 1996), without flux through the surface of the soil.
#pragma once
#include "core/stepping/model.hpp"

namespace gimpm {

/// Sets the variable `softening` of the points whose laws have it, as a step begins: the mean of a point is that of the
/// points of its own material. length: l > 0 [m]. All points are in this process, and cells are equal.
template <int Dim> void averageSoftening(PointCloud<Dim>&, const Model<Dim>&, double length);

} // namespace gimpm
