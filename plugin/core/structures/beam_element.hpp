// SPDX-License-Identifier: GPL-2.0-or-later
// A straight piece of a beam in the plane between two of its sections, by Euler and Bernoulli, in axes that turn with
// it.
#pragma once
#include "core/base/types.hpp"
#include "core/structures/linear_form.hpp"
#include <limits>

namespace gimpm {

/// Section of a beam, per metre of thickness; of a shell of revolution, per metre of its parallels.
struct BeamSection {
	double axialStiffness   = 0; ///< [N]
	double bendingStiffness = 0; ///< [N m2]
	double poisson          = 0; ///< Poisson's ratio of a shell of revolution
};

/// A piece as a step begins. Its axes are those of the chord between its ends.
struct BeamPiece {
	Vec<2> along;                       ///< from its first to its second end [m]
	double elongation = 0;              ///< elongation of the chord [m]
	double length0    = 1;              ///< without stress [m]
	Vec<2> turns      = Vec<2>::Zero(); ///< turns of its ends against the chord, without what has yielded, counterclockwise [rad]
	/// The largest moments at its ends [N m]; 0: a hinge.
	Vec<2> strength = Vec<2>::Constant(std::numeric_limits<double>::infinity());
};

/// Moments at the ends of a piece, positive counterclockwise, and how they go with the turns of the ends.
struct EndMoments {
	Vec<2> moment, yielded; ///< [N m], [rad]
	Mat<2> tangent;         ///< [N m]
	double energy = 0;
};
EndMoments endMoments(const BeamPiece&, const BeamSection&, const Vec<2>& turns);

/// Deformation of a piece after its ends have moved and turned by u = (u1, turn1, u2, turn2).
struct BeamShape {
	Vec<2> direction, turns;
	double length, elongation;

	BeamShape(const BeamPiece&, const Eigen::Matrix<double, 6, 1>& u);
};

/// Energy of these coordinates. With c, s the direction of the chord of length l, r = (-c, -s, 0, c, s, 0) and z = (s,
/// -c, 0, -s, c, 0): dl = r.du, and the chord turns by z.du / l (Crisfield 1991, section 7.3).
Energy<6> energyOf(const BeamPiece&, const BeamSection&, const Eigen::Matrix<double, 6, 1>& u);

} // namespace gimpm
