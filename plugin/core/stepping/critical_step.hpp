// SPDX-License-Identifier: GPL-2.0-or-later
// Longest stable time step by central differences.
#pragma once
#include "core/stepping/model.hpp"

namespace gimpm {

/// Largest values that decide about frequencies, of all points, of all processes where they are divided.
struct Stiffest {
	double pressureWave = 0; ///< squared speed c^2 of pressure waves, stiffening under compression included [m2/s2]
	double bar          = 0; ///< Young's modulus over density [m2/s2]
	double spacing      = 0; ///< size of the domains, in cells where they are
};
template <int Dim> Stiffest stiffest(const PointCloud<Dim>&, const Model<Dim>&);
template <int Dim> Stiffest stiffestOfOwn(const PointCloud<Dim>&, const Model<Dim>&); ///< points of this process

/// 2 / omega_max [s] of the body in its present state, by
///
///     omega_max^2 <= (C^2 c^2 + gamma_K / gamma_M E / density + 16 penalty E / density) / h^2
///
/// Here c is the speed of pressure waves, and the penalty of contacts and walls is weighed four times as much as
/// stability needs: a bar that bounces off a Box wins energy with the longest stable step, and hardly any with half of
/// it (examples/waves/explicit.py). C is the largest of many blocks that cut cells anywhere, with Poisson's ratios 0 to
/// 0.49 and 2 to 4 points along each axis of a cell (tests/core/stepping/test_explicit.cpp). Where domains are larger
/// than three quarters of a cell there are too few points for the consistent mass, and C grows. Where cells have
/// several sizes, h is that of the smallest.
template <int Dim> double criticalStep(const PointCloud<Dim>&, const Model<Dim>&, double ghostMass, double penalty);

} // namespace gimpm
