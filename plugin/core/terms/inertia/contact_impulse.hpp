// SPDX-License-Identifier: GPL-2.0-or-later
// Change of velocities of nodes by contact of bodies of points in an explicit step.
#pragma once
#include "core/terms/bodies/body_contact.hpp"
#include "core/terms/inertia/nodal_mass.hpp"
#include <optional>

namespace gimpm {

/// Forces r with which contact resists at the end of the step act through all of it (Kane et al. 1999): they solve
/// M (v - v_free) + T (r(T v) - r_0) = 0 at the free degrees of freedom, where v_free has the velocities in the centre
/// of the step, with the part r_0 of them that the rest of the step knows of. Of a spring that stays before one plane
/// this takes energy, however stiff it is, and so it does not shorten the critical step.
template <int Dim> class ContactImpulse {
public:
	ContactImpulse(const BodyContact<Dim>&, const NodalMass<Dim>&, const FreeDofs&, double duration);

	/// -T (r - r_0) at all nodes [N s]; none if that comes to no end.
	std::optional<Eigen::VectorXd> operator()(const Eigen::VectorXd& free) const;

private:
	struct Iterate {
		Eigen::VectorXd velocity, impulse, rest; // rest: what is out of balance
		double          size;                    // part out of balance by round-off or for want of iterations
	};
	Iterate                        at(Eigen::VectorXd velocity, const Eigen::VectorXd& free, Couplings*) const;
	std::optional<Eigen::VectorXd> change(const Iterate&, const Couplings&) const;

	const BodyContact<Dim>& contact_;
	const NodalMass<Dim>&   mass_;
	const FreeDofs&         dofs_;
	const double            duration_;
	const DofMap            map_;
	Eigen::VectorXd         known_; // r_0
};

} // namespace gimpm
