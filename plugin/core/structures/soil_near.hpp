// SPDX-License-Identifier: GPL-2.0-or-later
// State of the soil around positions of a line.
#pragma once
#include "core/terms/term.hpp"

namespace gimpm {

/// The mean of the points of a layer (-1: of any) within a reach of a position along each axis, which count the more
/// the nearer they are.
template <int Dim> struct SoilNear {
	SymTensor<Dim> stress {}; ///< Cauchy stress in the plane or in space [Pa]
	double         young = 0; ///< [Pa]; 0: there are no points
};

template <int Dim>
std::vector<SoilNear<Dim>> soilNear(const std::vector<Vec<Dim>>& positions, const std::vector<double>& reach, const StepContext<Dim>&, int layer = -1);

} // namespace gimpm
