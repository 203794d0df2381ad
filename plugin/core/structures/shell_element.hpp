// SPDX-License-Identifier: GPL-2.0-or-later
// A piece of a shell of revolution between two of its parallels: the piece of a beam that is its meridian, with the
// strain and the curvature of its parallels.
#pragma once
#include "core/structures/beam_element.hpp"

namespace gimpm {

/// A piece as a step begins. The radius is along x, and the axis of revolution is x = 0.
struct ShellPiece {
	BeamPiece meridian;                  ///< its strengths do not count: a shell is elastic
	Vec<2>    radius0  = Vec<2>::Ones(); ///< radii of its ends without stress [m]; not both 0
	Vec<2>    outwards = Vec<2>::Zero(); ///< growth of the radii of its ends [m]
	double    slope0   = 0;              ///< sine of the angle of its meridian to the radius, without stress
};

/// Strains and curvatures are those of Reissner (1950): of the meridian as of a beam, of the parallels (r - R) / R
/// and (sin phi - sin phi0) / R, where phi is the angle of the meridian to the radius, r the radius now, of the
/// chord, and R that without stress. So forces around the axis turn no end of a piece, as loads at the vertices do
/// not. Forces are E t / (1 - nu^2) times (e + nu e'), moments E t^3 / 12 (1 - nu^2) times (k + nu k'), by length of
/// the section without stress. The energy is that of the whole ring, of (u1, turn1, u2, turn2).
Energy<6> energyOf(const ShellPiece&, const BeamSection&, const Eigen::Matrix<double, 6, 1>& u);

/// Forces by length of the section, in the centre of the piece or at its two ends.
struct ShellForces {
	double axial, shear, hoop; ///< [N/m]; shear as the slope of the moment of a beam
	Vec<2> moments;            ///< moments of the meridian on the ends, counterclockwise [N m/m]
	Vec<2> hoopMoments;        ///< at the ends, positive where the parallels are bent to the left of the meridian [N m/m]
};
ShellForces forcesIn(const ShellPiece&, const BeamSection&, const Eigen::Matrix<double, 6, 1>& u);

} // namespace gimpm
