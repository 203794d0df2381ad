// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/contact/rolling.hpp"
#include "core/base/sentence.hpp"

namespace yade {

namespace {
	// Distance from a position to the point of a body that is farthest in a direction, along it [m].
	template <int Dim> Real reachTowards(const gimpm::RigidBody<Dim>& body, const gimpm::Vec<Dim>& from, const gimpm::Vec<Dim>& direction)
	{
		using gimpm::RigidKind;
		const auto&           shape  = body.shape;
		const Real            centre = direction.dot(body.end.position - from);
		const gimpm::Vec<Dim> own    = body.end.rotation.transpose() * direction;
		if (shape.kind == RigidKind::block) return centre + own.cwiseAbs().dot(shape.halfSize);
		if (shape.kind != RigidKind::sheet) return centre + shape.radius;
		Real corner = own.dot(shape.corners[0]);
		for (const auto& x : shape.corners)
			corner = std::max(corner, own.dot(x));
		return centre + corner;
	}

	// Distance from its position to the soil, against the force on it [m].
	template <int Dim> Real radiusOf(const gimpm::ContactSystem<Dim>& system, int owner, const gimpm::Vec<Dim>& direction)
	{
		Real radius = 0;
		for (const auto& body : system.bodies)
			if (body.owner == owner) radius = std::max(radius, reachTowards<Dim>(body, system.owners[owner], direction));
		return radius;
	}
}

template <int Dim> string warningOfRolling(const Body& body, const gimpm::ContactSystem<Dim>& system, int owner, Real cellSize)
{
	constexpr Real  far = 0.5, mostSlip = 0.5, fewest = 4 - 1e-6; // [rad], [-], cells
	const State&    state    = *body.state;
	const Vector3r& force    = system.loads[owner].force;
	const bool      isSphere = dynamic_cast<const Sphere*>(body.shape.get());
	if (!isSphere && !body.isClump()) return "";
	if (force.isZero(0) || state.vel.isZero(0) || state.refOri.angularDistance(state.ori) < far) return "";
	const Vector3r towards = -force.normalized();
	const Real     radius  = radiusOf<Dim>(system, owner, towards.head<Dim>());
	if (!(radius < fewest * cellSize)) return "";
	// Velocity of the body where it touches over that of its centre: 0 of one that rolls, 1 of one that slides.
	if (!((state.vel + state.angVel.cross(radius * towards)).norm() < mostSlip * state.vel.norm())) return "";
	return gimpm::sentence(
	        "body #", body.id, isSphere ? ", a Sphere" : ", a clump", " with ", radius / cellSize,
	        isSphere ? " cells over its radius" : " cells between its centre and the soil",
	        ", is free and rolls: on few cells it is late, most of all in MpmImplicitEngine, whose soil has no inertia. Take MpmDynamicEngine, and four "
	        "cells over the radius.");
}

template string warningOfRolling<2>(const Body&, const gimpm::ContactSystem<2>&, int, Real);
template string warningOfRolling<3>(const Body&, const gimpm::ContactSystem<3>&, int, Real);

} // namespace yade
