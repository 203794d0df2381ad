// SPDX-License-Identifier: GPL-2.0-or-later
// Rigid bodies that move as the soil and their loads make them, within the equilibrium of a step.
#pragma once
#include "core/base/types.hpp"
#include <array>
#include <functional>
#include <vector>

namespace gimpm {

/// The matrix that a small turn is multiplied with to give what it moves at the end of an arm; transposed, the moment
/// that a force has about its begin. In the plane a turn is a number.
Vec<2> turnsArm(const Vec<2>& arm);
Mat3   turnsArm(const Vec3& arm);
template <int Dim> using Turn = Eigen::Matrix<double, Dim == 2 ? 1 : 3, 1>;

/// Owner of bodies that moves freely in a step. Its unknowns are a displacement and a turn q about its position, for
/// which J q + (forces and moments on the soil) - externalLoad = 0. With a force F that is constant in the step and q =
/// T ((1 - a) v_0 + a v_1), v_1 = v_0 + T F / m: so J = M / (a T^2), externalLoad = weight and loads + M v_0 / (a T),
/// and the body loses the momentum that the soil gains. The scheme keeps the part (1 - a) / a of the highest
/// frequencies in each step. In statics J = 0.
template <int Dim> struct FreeBody {
	static constexpr int unknowns = Dim + Turn<Dim>::RowsAtCompileTime;
	using Vector                  = Eigen::Matrix<double, unknowns, 1>;
	using Matrix                  = Eigen::Matrix<double, unknowns, unknowns>;

	int                        owner;    ///< in the system
	Vec<Dim>                   position; ///< at the beginning of the step [m]
	std::array<bool, unknowns> isGiven {};
	Matrix                     inertia      = Matrix::Zero(); ///< J [N/m], [N m]
	Vector                     externalLoad = Vector::Zero(); ///< [N], [N m]
	/// A first guess, with the values of what is given; then a result [m], [rad].
	Vector motion    = Vector::Zero();
	bool   isAtRest  = true; ///< in balance with the soil at the last iterate
	double imbalance = 0;    ///< rest of the forces there, over their absolute contributions
};

/// A turn as a rotation.
Mat<2> rotationOf(const Turn<2>&);
Mat3   rotationOf(const Turn<3>&);

/// Matrix that makes a change of the motion a small displacement and turn of the body as it is: in space turns do not
/// add.
template <int Dim> typename FreeBody<Dim>::Matrix incrementsOf(const typename FreeBody<Dim>::Vector& motion);
template <> FreeBody<2>::Matrix                   incrementsOf<2>(const FreeBody<2>::Vector& motion);
template <> FreeBody<3>::Matrix                   incrementsOf<3>(const FreeBody<3>::Vector& motion);

/// The force at one contact point, and how it depends on soil and body there.
template <int Dim> struct FreeContactPoint {
	Vec<Dim> arm;     ///< from the owner to the contact point, at the iterate [m]
	Vec<Dim> force;   ///< on the soil [N]
	Mat<Dim> tangent; ///< its derivative by the contact point [N/m]
	double   gap;     ///< > 0: it does not touch [m]
	Vec<Dim> normal;
};

/// Derivatives of a force at a contact point by the unknowns of its body: with B the displacement of the contact point
/// by the body's, df = tangent (du - B dq) + turned dq, and for the force on the body d(B^T f) = B^T df + byPosition du
/// + byBody dq.
template <int Dim> struct RigidBodyJacobian {
	using Free = FreeBody<Dim>;
	Eigen::Matrix<double, Dim, Free::unknowns> moves, turned;
	Eigen::Matrix<double, Free::unknowns, Dim> byPosition;
	typename Free::Matrix                      byBody;

	explicit RigidBodyJacobian(const FreeContactPoint<Dim>&);

	/// Derivative of the force on the soil by q, and of that on the body by the contact point.
	Eigen::Matrix<double, Dim, Free::unknowns> forceByBody(const Mat<Dim>& tangent) const { return turned - tangent * moves; }
	Eigen::Matrix<double, Free::unknowns, Dim> bodyByPosition(const Mat<Dim>& tangent) const { return moves.transpose() * tangent + byPosition; }
	typename Free::Matrix                      bodyByBody(const Mat<Dim>& tangent) const { return moves.transpose() * forceByBody(tangent) + byBody; }
};

/// Finds the motion of the body; `look` puts the bodies at a motion and tells the contact points, all of them. False:
/// there is no equilibrium that could be found, and the motion is the best one that was.
template <int Dim>
bool solveRigidBodyMotion(FreeBody<Dim>&, double size, const std::function<std::vector<FreeContactPoint<Dim>>(const typename FreeBody<Dim>::Vector&)>& look);

/// The inverse of the derivative of what is out of balance by the motion, zero for what is given; `size` of the body
/// makes turns comparable with displacements [m]. What nothing resists does not move.
template <int Dim> typename FreeBody<Dim>::Matrix compliance(const FreeBody<Dim>&, double size, const std::vector<FreeContactPoint<Dim>>&);

} // namespace gimpm
