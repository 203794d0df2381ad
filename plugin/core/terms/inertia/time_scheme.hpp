// SPDX-License-Identifier: GPL-2.0-or-later
// Relations of displacements, velocities and accelerations of a time step.
#pragma once

namespace gimpm {

/// Newmark's family: d = T v_0 + T^2 ((1/2 - beta) a_0 + beta a_1), v_1 = v_0 + T ((1 - gamma) a_0 + gamma a_1), with
/// equilibrium of (1 - alphaM) a_1 + alphaM a_0 and of the forces (1 - alphaF) f_1 + alphaF f_0 (Chung and Hulbert
/// 1993).
struct TimeScheme {
	double beta = 0.25, gamma = 0.5, alphaM = 0, alphaF = 0;
	/// Internal forces are those after half of the displacements (Model::atMiddle), and loads those in the centre
	/// of the step.
	bool atMiddle   = false;
	bool isExplicit = false; ///< nothing is solved but for the mass (core/stepping/explicit_step.hpp)

	static TimeScheme newmark(double beta, double gamma) { return { beta, gamma }; }

	/// `radius`: what is left of the highest frequencies in each step, 0 to 1; second order for each.
	static TimeScheme generalisedAlpha(double radius)
	{
		const double m = (2 * radius - 1) / (radius + 1), f = radius / (radius + 1), spread = 1 - m + f;
		return { spread * spread / 4, 0.5 - m + f, m, f };
	}

	/// v_1 = 2 d / T - v_0 and a_1 = (v_1 - v_0) / T. Angular momentum is kept.
	static TimeScheme midpoint() { return { 0.5, 1, 0, 0, true }; }

	/// Newmark's with beta = 0: d = T v_0 + T^2 / 2 a_0 is known as the step begins
	/// (core/terms/inertia/explicit_inertia.hpp). Stable up to the critical step (core/stepping/critical_step.hpp).
	static TimeScheme centralDifferences() { return { 0, 0.5, 0, 0, false, true }; }

	/// Weight of contact forces in the balance, so that they act with their value at the end of the step all
	/// through it (C. Kane et al. 1999): in the mean of two ends they would give energy to what bounces.
	double weightOfContact() const { return isExplicit ? 1 : (1 - alphaM) / (2 * beta * (1 - alphaF)); }

	bool dependsOnStart() const { return beta != 0.5 || gamma != 1; } ///< on a_0
	bool isAlpha() const { return alphaF != 0 || alphaM != 0; }       ///< equilibrium is weighed over the step
};

} // namespace gimpm
