// SPDX-License-Identifier: GPL-2.0-or-later
// A contact point on the surface of one body before a piece of that of another: penalty, friction, and exact
// derivatives.
#pragma once
#include "core/terms/contact/contact_law.hpp"
#include <array>

namespace gimpm {

/// The contact point first, then the vertices of the piece, a segment or a triangle.
template <int Dim> using PairPositions = std::array<Vec<Dim>, Dim + 1>;

/// A contact point before the plane of a piece. The foot of the contact point is the sum of weight[i] times vertex i.
template <int Dim> struct Facing {
	explicit Facing(const PairPositions<Dim>&);

	double                    gap;    ///< along the normal of the piece, < 0 behind it [m]
	Vec<Dim>                  normal; ///< normal of the piece, outward
	std::array<double, Dim>   weight;
	std::array<Vec<Dim>, Dim> weightGradient; ///< gradients of the weights, along the piece [1/m]
	/// Unit vectors along the piece, which turn with it: the first one along its first side.
	std::array<Vec<Dim>, Dim - 1> along;
};

/// Squared distance of the contact point from the piece within its sides.
double squaredDistance(const PairPositions<2>&);
double squaredDistance(const PairPositions<3>&);

/// Weights of the vertices at the position of the piece that is closest to the contact point.
std::array<double, 2> closestWeights(const PairPositions<2>&);
std::array<double, 3> closestWeights(const PairPositions<3>&);

/// Kind of Jacobian. The symmetric one leaves out what is not: that the limit of friction grows with the pressure, and
/// small parts by the turn of the piece.
enum class PairJacobian { none, symmetric, exact };

/// Forces between the contact point and the piece, whatever grids they move with. They have neither resultant nor
/// moment.
template <int Dim> struct PairAction {
	std::array<Vec<Dim>, Dim + 1> force;                              ///< on the contact point and on the vertices [N]
	double                        normalForce     = 0;                ///< [N]
	Vec<Dim>                      tangentialForce = Vec<Dim>::Zero(); ///< on the contact point [N]
	Vec<Dim>                      slip  = Vec<Dim>::Zero(); ///< slip of the contact point along the matter of the piece, since the start of the step [m]
	bool                          slips = false;
};

/// The action with its derivative.
template <int Dim> struct PairForce : PairAction<Dim> {
	static constexpr int size = Dim * (Dim + 1);

	using Tangent = Eigen::Matrix<double, size, size>;

	Tangent tangent = Tangent::Zero(); ///< derivative of the forces by the contact points [N/m], if asked for
};

/// Force of a penalty on the gap, and of Coulomb's friction with a cap, by return mapping from a penalty on the slip.
/// `start`: the positions as the step begins, when the tangential force on the contact point is `before`; it turns with
/// the piece. `closed`: the gap at which the pressure begins. None where the gap is wider than that by more than the
/// tolerance. A contact point within it that is not pressed counts as sticking in the Jacobian: a body that only
/// touches is constrained.
template <int Dim>
std::optional<PairForce<Dim>> pairForce(
        const ContactLaw<Dim>&, const PairPositions<Dim>& start, const Vec<Dim>& before, const PairPositions<Dim>& now, double closed, double tolerance,
        PairJacobian);

} // namespace gimpm
