// SPDX-License-Identifier: GPL-2.0-or-later
// Load on a body from the force at a contact point.
#include "core/terms/contact/contact.hpp"
#include "core/terms/contact/contact_nodes.hpp"
#include <cmath>

namespace gimpm {

template <int Dim> Mat<Dim> Contact<Dim>::resistanceOf(const ContactPoint& at, const Touch<Dim>& touched) const
{
	const double along = touched.slips || at.law.frictionCoefficient == 0 || at.law.cap == 0 ? 0 : at.law.tangentialStiffness;
	return at.law.normalStiffness * touched.normal * touched.normal.transpose()
	        + along * (Mat<Dim>::Identity() - touched.normal * touched.normal.transpose());
}

/// On a ball: where the normal of its face goes through its centre, around which pressure does not turn it. The soil
/// has slipped from there in a time step.
template <int Dim> Vec<Dim> Contact<Dim>::pointOfForce(const ContactPoint& at, const Vec<Dim>& soil, const Vec<Dim>& normal) const
{
	const auto& body = system_.bodies[at.body];
	if (body.shape.kind != RigidKind::ball || system_.kind != StepKind::dynamic) return soil;
	return body.end.position + (soil - body.end.position).dot(normal) * normal;
}

template <int Dim> ContactLoad Contact<Dim>::loadOn(const Vec<Dim>& owner, const ContactPoint& at, const Vec<Dim>& position, const Touch<Dim>& touched) const
{
	ContactLoad load;
	Vec3        arm                 = Vec3::Zero();
	load.force.template head<Dim>() = -touched.force();
	arm.template head<Dim>()        = position - owner;
	load.torque                     = arm.cross(load.force);
	if (isRing_) load.force[0] = 0, load.torque.setZero(); // all around the axis they add up to nothing
	if constexpr (Dim == 3) {
		const Mat3                  resists = resistanceOf(at, touched);
		Eigen::Matrix<double, 3, 6> moves;
		moves << Mat3::Identity(), (Mat3() << 0, arm[2], -arm[1], -arm[2], 0, arm[0], arm[1], -arm[0], 0).finished();
		load.stiffness = moves.transpose() * resists * moves;
	}
	return load;
}

template <int Dim> void Contact<Dim>::addLoads(const ContactPoint& at, const Vec<Dim>& position, const Touch<Dim>& touched)
{
	const auto& body = system_.bodies[at.body];
	if constexpr (Dim == 3)
		if (body.nodes > 0) {
			const auto loads = loadsOnNodes(body, at.soil, { -touched.force(), position, resistanceOf(at, touched), at.area, at.young });
			for (int i = 0; i < body.nodes; ++i)
				system_.loads[body.nodeOwners[i]] += loads[i];
			return;
		}
	ContactLoad load = loadOn(system_.owners[body.owner], at, pointOfForce(at, position, touched.normal), touched);
	load.area = at.area, load.young = at.area * at.young;
	system_.loads[body.owner] += load;
}

template void   Contact<2>::addLoads(const ContactPoint&, const Vec<2>&, const Touch<2>&);
template void   Contact<3>::addLoads(const ContactPoint&, const Vec<3>&, const Touch<3>&);
template Vec<2> Contact<2>::pointOfForce(const ContactPoint&, const Vec<2>&, const Vec<2>&) const;
template Vec<3> Contact<3>::pointOfForce(const ContactPoint&, const Vec<3>&, const Vec<3>&) const;

} // namespace gimpm
