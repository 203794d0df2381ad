// SPDX-License-Identifier: GPL-2.0-or-later
// The internal force with F-bar, compiled apart.
#pragma once
#include "core/terms/term.hpp"

namespace gimpm {

/// Of each point, in the order of the basis: the slopes of its basis functions, with the values that the hat functions have at the centre of the
/// matter in a cell instead of those at the point, averaged over the cells that its domain lies in; 1/2 where all cells are full. So the points of a
/// cell have on average the gradients of their own basis functions, and a uniform stress stays in balance where cells are partly filled: exactly for
/// boxes of matter, whereas gradients in the middle of the cells left 3 % of the stress along the cut edges of a bar.
template <int Dim> std::vector<PointBasis<Dim>> basisAtCentres(const PointCloud<Dim>&, const CloudBasis<Dim>&);

template <int Dim> struct Pass;
template <int Dim> std::optional<PointFailure> addFBarForce(const Pass<Dim>&);

} // namespace gimpm
