// SPDX-License-Identifier: GPL-2.0-or-later
// Check that the body still carries its load with a part of its strength, at small displacements.
#pragma once
#include "core/materials/weakening.hpp"
#include "core/stepping/load_step.hpp"
#include "core/stepping/step_control.hpp"

namespace gimpm {

template <int Dim> struct WeakBody {
	bool                  carries    = false; ///< there is equilibrium with the whole reduction
	double                reached    = 1;     ///< factor of the last equilibrium
	int                   iterations = 0, parts = 0;
	std::string           cause;         ///< why it does not
	std::vector<Vec<Dim>> displacement;  ///< displacements of the points, to the last state [m], small or not
	std::vector<double>   plasticStrain; ///< strain that has been added meanwhile
};

/// Strains that a body may have by elasticity, for displacements that are small: the moduli are scaled up to that.
/// Stresses stay as they are, and so does the load that they can carry; what comes out is scaled back, so that
/// displacements are those of the theory of small displacements.
inline constexpr double smallStrain = 1e-7;
/// Part of the ghost stabilisation that is left: unreduced, it holds what flows, in a slip one cell thick by some
/// percent of the strength.
inline constexpr double ghostShare = 1e-2;
/// Displacements that count as flow, over the largest elastic strain times the smallest extent of the body. Of a
/// vertical cut that is H / 70, where elasticity gives H / 300; left to itself a body that flows would find another
/// equilibrium at last, held by ghost stabilisation or with another geometry.
inline constexpr double flowsBeyond = 3;

/// From a state in equilibrium under a constant load, in which points do not move: the strength falls in parts, cut as
/// load steps are.
template <int Dim> WeakBody<Dim> reduceStrength(const PointCloud<Dim>&, const Model<Dim>&, const Load<Dim>&, double factor, StepControl, LinearSolver&);

} // namespace gimpm
