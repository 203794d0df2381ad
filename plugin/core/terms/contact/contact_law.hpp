// SPDX-License-Identifier: GPL-2.0-or-later
// Force of a rigid body on one contact point of the soil that touches it.
#pragma once
#include "core/terms/contact/rigid_body.hpp"
#include <optional>

namespace gimpm {

template <int Dim> struct ContactLaw {
	double normalStiffness, tangentialStiffness; ///< stiffness of the penalty [N/m]
	double frictionCoefficient;                  ///< [-]
	double cap;                                  ///< cap of the tangential force [N]
	/// Normal force of the neighbouring contact points and this one, which friction refers to at least [N]; the gap
	/// up to which it does [m].
	double around = 0, reach = 0;
};

/// Position of the soil relative to the body, and its motion along the body in the step.
template <int Dim> struct Approach {
	Proximity<Dim> at;              ///< at the end of the step; the gap less that which counts as none
	Vec<Dim>       slip;            ///< relative displacement in the step [m]
	Mat<Dim>       slipDerivative;  ///< its derivative by the contact point
	Vec<Dim>       tangentialForce; ///< at the end of the last step [N]
};

template <int Dim> struct Touch {
	/// Normal of the body; tangential force on the soil [N].
	Vec<Dim> normal = Vec<Dim>::Zero(), tangentialForce = Vec<Dim>::Zero();
	double   normalForce = 0; ///< [N]
	bool     slips       = false;
	Mat<Dim> tangent     = Mat<Dim>::Zero(); ///< derivative of the force by the position [N/m]

	Vec<Dim> force() const { return normalForce * normal + tangentialForce; } ///< on the soil
};

/// A penalty on the gap, and Coulomb's friction with a cap, returned from a penalty on the slip since the contact point
/// began to stick. None where the gap is wider than the tolerance. Within it a contact point that is not pressed counts
/// as sticking in the derivative: a body that only touches is held.
template <int Dim> std::optional<Touch<Dim>> touch(const ContactLaw<Dim>&, const Approach<Dim>&, double tolerance);

} // namespace gimpm
