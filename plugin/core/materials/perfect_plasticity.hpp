// SPDX-License-Identifier: GPL-2.0-or-later
// Common part of laws of perfect plasticity with faces, edges and an apex.
//
// Stress is continuous over the boundaries between the sectors of a return, so that it may be chosen by exact tests:
// where round-off chooses, both sides agree. The tangent jumps there. It is chosen by tests with a tolerance, in favour
// of the sector that leaves more stiffness; else round-off would choose it for all states that lie on a boundary, as
// those do that were returned to an edge in the step before.
#pragma once
#include "core/materials/hencky.hpp"

namespace gimpm {

/// Tolerance of those tests, relative to the size of the trial stress.
inline constexpr double sectorTolerance = 1e-9;

/// On an edge the tangent has rank one, at an apex it is zero: a body of such points would make the stiffness singular.
/// This part of the elastic stiffness is added to their tangent, not to their stress, so that equilibrium is the same.
/// Of nine blocks without cohesion that are pulled or pressed in three steps it leaves one that does not converge (1e-6
/// and 1e-4: two; none: seven, four of them because the stiffness is singular). Slopes of sand take as many iterations
/// with 0 to 1e-3; with 1e-2 one of them stops.
inline constexpr double tangentFloor = 1e-8;

/// Weakened cohesion, frictionAngle, dilationAngle, tensileStrength behind Young's modulus; the soil cannot dilate more
/// than it has friction.
inline std::array<double, 5> weakenedFriction(const std::array<double, 5>& parameters, const Weakening& w)
{
	const auto [young, cohesion, friction, dilation, tension] = parameters;
	const double angle                                        = w.reducedAngle(friction);
	return { young * w.moduli, cohesion / w.strength, angle, std::min(dilation, angle), tension / w.strength };
}

/// Equivalent plastic strain of a return: sqrt(2/3) times the norm of the deviator.
template <class T> GIMPM_INLINE T equivalentPlasticStrainOf(const PrincipalValues<T>& trialStrain, const PrincipalValues<T>& elasticStrain)
{
	const PrincipalValues<T> flow = trialStrain - elasticStrain;
	const T                  a = flow[0] - flow[1], b = flow[1] - flow[2], c = flow[2] - flow[0];
	return T(std::sqrt(2.) / 3) * sqrt(a * a + b * b + c * c);
}

} // namespace gimpm
