// SPDX-License-Identifier: GPL-2.0-or-later
// A straight piece of a bar that only stretches.
#pragma once
#include "core/base/types.hpp"
#include "core/structures/linear_form.hpp"
#include <optional>

namespace gimpm {

/// Section of a bar.
struct BarSection {
	double stiffness   = 0;                                       ///< force over logarithmic strain [N]
	double strength    = std::numeric_limits<double>::infinity(); ///< force at which it yields [N]
	bool   tensionOnly = true;                                    ///< slack where it would be compressed

	/// Energy per length of a strain without yielding in this step, the force conjugate to the strain and its
	/// tangent.
	Energy<1> at(double strain) const
	{
		Energy<1> energy;
		if (tensionOnly && strain < 0) return energy;
		const double force = stiffness * strain, sign = force < 0 ? -1 : 1;
		if (std::abs(force) > strength) {
			energy.value       = strength * (std::abs(strain) - strength / stiffness / 2);
			energy.gradient[0] = sign * strength;
		} else {
			energy.value         = force * strain / 2;
			energy.gradient[0]   = force;
			energy.hessian(0, 0) = stiffness;
		}
		return energy;
	}

	/// Elastic part of a strain once the bar has yielded: of a slack bar all of it, so that it is stretched again
	/// where it was.
	double elastic(double strain) const
	{
		if (tensionOnly && strain < 0) return strain;
		return std::max(-strength / stiffness, std::min(strength / stiffness, strain));
	}
};

/// A piece as a step begins.
template <int Dim> struct BarPiece {
	Vec<Dim>              along;       ///< from its first to its second end [m]
	double                strain  = 0; ///< logarithmic, elastic
	double                length0 = 1; ///< without stress [m]
	std::optional<double> given {};    ///< force of a jack, which stretches it as far as that takes [N]

	/// The strain after its ends have moved apart by this vector, from its growth: no digits are lost where lengths
	/// are large and displacements small.
	double strainAfter(const Vec<Dim>& apart) const { return strain + 0.5 * std::log1p(apart.dot(2 * along + apart) / along.squaredNorm()); }
};

/// The coordinates are the displacements of the first and of the second end. With e = ln(l / L0), t along the piece and
/// g = (-t, t): force N (L0 / l) g, derivative (L0 / l^2) ((N' - N) g g^T + N (P, -P; -P, P)), P = 1 - t t^T.
template <int Dim> Energy<2 * Dim> energyOf(const BarPiece<Dim>& piece, const BarSection& section, const Eigen::Matrix<double, 2 * Dim, 1>& u)
{
	const Vec<Dim> apart = u.template tail<Dim>() - u.template head<Dim>(), now = piece.along + apart;
	const double   length = now.norm();
	const Vec<Dim> t      = now / length;

	Eigen::Matrix<double, 2 * Dim, 1> g;
	g << -t, t;
	const Mat<Dim>                          P = Mat<Dim>::Identity() - t * t.transpose();
	Eigen::Matrix<double, 2 * Dim, 2 * Dim> across;
	across << P, -P, -P, P;

	Energy<2 * Dim> energy;
	if (piece.given) {
		energy.value    = *piece.given * (length - piece.along.norm());
		energy.gradient = *piece.given * g;
		energy.hessian  = *piece.given / length * across;
		return energy;
	}
	const Energy<1> law   = section.at(piece.strainAfter(apart));
	const double    force = law.gradient[0], over = piece.length0 / length;
	energy.value    = piece.length0 * law.value;
	energy.gradient = force * over * g;
	energy.hessian  = over / length * ((law.hessian(0, 0) - force) * g * g.transpose() + force * across);
	return energy;
}

} // namespace gimpm
