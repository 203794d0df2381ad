// SPDX-License-Identifier: GPL-2.0-or-later
// A place on the surface of one body before a piece of that of another: penalty, friction, and exact derivatives.
#pragma once
#include "core/terms/contact/contact_law.hpp"
#include <array>

namespace gimpm {

/// The place first, then the vertices of the piece, a segment or a triangle.
template <int Dim> using PairPlaces = std::array<Vec<Dim>, Dim + 1>;

/// A place before the plane of a piece. The foot of the place is the sum of weight[i] times vertex i.
template <int Dim> struct Facing {
	explicit Facing(const PairPlaces<Dim>&);

	double                    gap;    ///< along the normal of the piece, < 0 behind it [m]
	Vec<Dim>                  normal; ///< of the piece, outward
	std::array<double, Dim>   weight;
	std::array<Vec<Dim>, Dim> weightGradient; ///< of the weights, along the piece [1/m]
	/// Unit vectors along the piece, which turn with it: the first one along its first side.
	std::array<Vec<Dim>, Dim - 1> along;
};

/// Of the place from the piece, which has an end.
double squaredDistance(const PairPlaces<2>&);
double squaredDistance(const PairPlaces<3>&);

/// Which derivative of the forces is wanted. The symmetric one leaves out what is not: that the limit of friction grows
/// with the pressure, and small parts by the turn of the piece.
enum class PairJacobian { none, symmetric, exact };

/// What the place and the piece do to each other, whatever grids they move with. The forces have neither resultant nor
/// moment.
template <int Dim> struct PairAction {
	std::array<Vec<Dim>, Dim + 1> force;                              ///< on the place and on the vertices [N]
	double                        normalForce     = 0;                ///< [N]
	Vec<Dim>                      tangentialForce = Vec<Dim>::Zero(); ///< on the contact point [N]
	Vec<Dim>                      slip            = Vec<Dim>::Zero(); ///< of the place along the matter of the piece, since the start of the step [m]
	bool                          slips           = false;
};

/// The action with its derivative.
template <int Dim> struct PairForce : PairAction<Dim> {
	static constexpr int size = Dim * (Dim + 1);

	using Tangent = Eigen::Matrix<double, size, size>;

	Tangent tangent = Tangent::Zero(); ///< of the forces by the places [N/m], if it was asked for
};

/// Of a penalty on the gap, and Coulomb's friction with a cap, returned from a penalty on the slip. `start`: the places
/// as the step begins, when the frictional force on the place is `shear`; it turns with the piece. `closed`: the gap at
/// which the pressure begins. None where it is wider than that by more than the tolerance. A place within it that is
/// not pressed counts in the derivative as one that sticks: a body that only touches is held.
template <int Dim>
std::optional<PairForce<Dim>> pairForce(
        const ContactLaw<Dim>&, const PairPlaces<Dim>& start, const Vec<Dim>& before, const PairPlaces<Dim>& now, double closed, double tolerance,
        PairJacobian);

} // namespace gimpm
