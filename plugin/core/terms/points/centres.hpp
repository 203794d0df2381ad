// SPDX-License-Identifier: GPL-2.0-or-later
// Basis functions with the gradients at the centres of the matter in cells, for F-bar.
#pragma once
#include "core/grid/cloud_basis.hpp"

namespace gimpm {

/// Gradients of the basis functions of each point, in the order of the basis, with the values that the hat functions
/// have at the centre of the matter in a cell instead of those at the point, averaged over the cells that its domain
/// lies in; 1/2 where all cells are full. So the points of a cell have on average the gradients of their own basis
/// functions, and a uniform stress stays in balance where cells are partly filled: exactly for boxes of matter, whereas
/// gradients in the centre of the cells leave stress along the cut edges of a bar.
template <int Dim> std::vector<PointBasis<Dim>> basisAtCentres(const PointCloud<Dim>&, const CloudBasis<Dim>&);

/// The same of the functions of the hoop strain around an axis of symmetry: over the radius of the centre of the
/// matter's section, with which the points of a cell have on average the hoop functions of their own.
template <int Dim> std::vector<AxisValues> hoopAtCentres(const PointCloud<Dim>&, const CloudBasis<Dim>&);

} // namespace gimpm
