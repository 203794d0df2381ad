// SPDX-License-Identifier: GPL-2.0-or-later
// The law of one contact point: penalty on the gap, and Coulomb's friction with a cap by return mapping.
#pragma once
#include "core/terms/contact/rigid_body.hpp"
#include <algorithm>
#include <optional>

namespace gimpm {

/// Gap that counts as touching [m].
inline double contactTolerance(double cellSize) { return 1e-9 * cellSize; }

template <int Dim> struct ContactLaw {
	double normalStiffness, tangentialStiffness; ///< stiffness of the penalty [N/m]
	double frictionCoefficient;                  ///< [-]
	double cap;                                  ///< cap of the tangential force [N]
	/// Normal force of the neighbouring contact points and this one, which friction refers to at least [N]; the gap
	/// up to which it does [m].
	double around = 0, reach = 0;
	double water = 0; ///< part of the normal force that is the pressure of pore water, of which friction knows nothing [N]

	bool   isSmooth() const { return frictionCoefficient == 0 || cap == 0; }
	double normalForce(double gap) const { return std::max(0., -normalStiffness * gap); }
	double effective(double normalForce) const { return std::max(0., std::max(normalForce, around) - water); }
	double frictionLimit(double normalForce) const { return std::min(frictionCoefficient * effective(normalForce), cap); }

	/// Energy in the springs on gap and slip [J].
	double stored(double normalForce, double tangentialForce) const
	{
		return normalStiffness > 0 ? (normalForce * normalForce / normalStiffness + tangentialForce * tangentialForce / tangentialStiffness) / 2 : 0;
	}
};

/// Tangential force at a contact point.
template <int Dim> struct Friction {
	Vec<Dim> force = Vec<Dim>::Zero();
	bool     slips = false;
};

/// Returns the trial force to the limit of friction, and adds the derivative of what comes out to the tangent, if there
/// is one. `dTrial`, `dGap`: derivatives of the trial and of the gap by the same unknowns; without dGap the growth of
/// the limit with the pressure is left out.
template <int Dim, int Unknowns>
Friction<Dim> returnMapping(
        const ContactLaw<Dim>& law, double normalForce, const Vec<Dim>& trial, const Eigen::Matrix<double, Dim, Unknowns>* dTrial,
        const Eigen::Matrix<double, 1, Unknowns>* dGap, Eigen::Matrix<double, Dim, Unknowns>* tangent)
{
	const double limit = law.frictionLimit(normalForce), size = trial.norm();
	if (!(size > limit)) {
		if (tangent) *tangent += *dTrial;
		return { trial, false };
	}
	const Vec<Dim> along = trial / size;
	if (tangent) {
		*tangent += limit / size * (*dTrial - along * (along.transpose() * *dTrial));
		const bool growsWithPressure = normalForce >= law.around && 0 < limit && limit < law.cap;
		if (dGap && growsWithPressure) *tangent -= law.frictionCoefficient * law.normalStiffness * along * *dGap;
	}
	return { limit * along, true };
}

/// Position of the soil relative to the body, and its motion along the body in the step.
template <int Dim> struct Approach {
	Proximity<Dim> at;              ///< at the end of the step; the gap less that which counts as none
	Vec<Dim>       slip;            ///< relative displacement in the step [m]
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

/// Energy that the slip of a step dissipates: tangential force times the slip that its spring does not take [J].
template <int Dim> double dissipation(const ContactLaw<Dim>& law, const Approach<Dim>& near, const Touch<Dim>& touched)
{
	if (!touched.slips || !(law.tangentialStiffness > 0)) return 0;
	return touched.tangentialForce.dot((near.tangentialForce - touched.tangentialForce) / law.tangentialStiffness - near.slip);
}

/// Force of a rigid body on one contact point of the soil: the trial of the tangential force is a penalty on the slip
/// since the contact point began to stick. None where the gap is wider than the tolerance. Within it a contact point
/// that is not pressed counts as sticking in the derivative: a body that only touches is held.
template <int Dim> std::optional<Touch<Dim>> touch(const ContactLaw<Dim>&, const Approach<Dim>&, double tolerance);

} // namespace gimpm
