// SPDX-License-Identifier: GPL-2.0-or-later
// State of the soil around positions of a line.
#pragma once
#include "core/terms/term.hpp"
#include <functional>

namespace gimpm {

/// The mean of the points within a reach of a position along each axis, which count the more the nearer they are.
template <int Dim> struct SoilNear {
	SymTensor<Dim> stress {}; ///< Cauchy stress in the plane or in space [Pa]
	double         young = 0; ///< [Pa]; 0: there are no points
};

/// The state around positions, of the points that isTaken admits (null: of all).
template <int Dim>
std::vector<SoilNear<Dim>> soilNear(
        const std::vector<Vec<Dim>>& positions, const std::vector<double>& reach, const StepContext<Dim>&, const std::function<bool(int)>& isTaken = nullptr);

} // namespace gimpm
