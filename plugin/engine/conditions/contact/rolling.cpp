// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/contact/rolling.hpp"
#include "core/base/sentence.hpp"

namespace yade {

string warningOfRolling(const Body& body, const Vector3r& force, Real cellSize)
{
	constexpr Real far = 0.5, mostSlip = 0.5, fewest = 4 - 1e-6; // [rad], [-], cells
	const State&   state  = *body.state;
	const auto*    sphere = dynamic_cast<const Sphere*>(body.shape.get());
	if (!sphere || !(sphere->radius < fewest * cellSize)) return "";
	if (force.isZero(0) || state.vel.isZero(0) || state.refOri.angularDistance(state.ori) < far) return "";
	// Velocity of the sphere where it touches over that of its centre: 0 of one that rolls, 1 of one that slides.
	const Vector3r lever = -sphere->radius * force.normalized();
	if (!((state.vel + state.angVel.cross(lever)).norm() < mostSlip * state.vel.norm())) return "";
	return gimpm::sentence(
	        "body #", body.id, ", a Sphere with ", sphere->radius / cellSize,
	        " cells over its radius, is free and rolls: on few cells it is late, most of all in MpmImplicitEngine, whose soil has no inertia. Take "
	        "MpmDynamicEngine, and four cells over the radius.");
}

} // namespace yade
