// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies in contact that move within the equilibrium of a step.
#include "core/base/sentence.hpp"
#include "engine/conditions/contact/contacts.hpp"
#include "engine/conditions/contact/rigid_bodies.hpp"

namespace yade {

// Makes it one that moves with the soil.
template <int Dim> void Contacts<Dim>::free(Owner& owner, const Scene& scene, const gimpm::Grid<Dim>& grid)
{
	const Body& body = *owner.body;
	FreeMotion  motion { owner.given, body.state->vel, body.state->angVel, massOf<Dim>(body, scene, grid), {}, {}, body.state->blockedDOFs, inTime };
	requireSolvable(body, motion.mass, owner.byYade, inTime);
	if (isExplicit)
		throw std::invalid_argument(
		        "MpmContact.implicit: explicit steps solve nothing, into which a body could go; let YADE move it in 3D, or take an implicit scheme.");
	const State& state = *body.state;
	if (Dim == 2
	    && (state.vel[2] != 0 || state.angVel[0] != 0 || state.angVel[1] != 0 || (grid.axisymmetric && (state.vel[0] != 0 || state.angVel[2] != 0))))
		throw std::invalid_argument(gimpm::sentence(
		        "MpmContact.implicit: body #", body.id, " has the velocity (", state.vel.transpose(), ") and turns by (", state.angVel.transpose(),
		        "): ",
		        grid.axisymmetric ? "around the axis of symmetry only movement along it is admitted." : "with dim=2 it can only move in the plane."));
	auto& forces = const_cast<ForceContainer&>(scene.forces);
	forces.sync();
	motion.force = forces.getForce(body.id), motion.torque = forces.getTorque(body.id);
	owner.free   = int(system->free.size());
	owner.motion = motion;
	system->free.push_back(freeBody<Dim>(int(owners.size()), motion, target - begin, Vector3r::Zero(), grid.axisymmetric));
}

// Moves free bodies to the poses without the soil, to begin with.
template <int Dim> void Contacts<Dim>::advanceFree(const StepTime& step, bool isRing)
{
	const Vector3r weight = ofGravity->valueAt(step.looked) * gravity;
	for (size_t i = 0; i < owners.size(); ++i)
		if (owners[i].free >= 0) system->free[owners[i].free] = freeBody<Dim>(int(i), owners[i].motion, step.to - step.from, weight, isRing);
	for (size_t i = 0; i < members.size(); ++i) {
		auto&        rigid = system->bodies[i];
		const Owner& owner = owners[rigid.owner];
		if (owner.free < 0) continue;
		const auto at    = [&](const Se3r& pose) { return yade::poseOf<Dim>(*members[i].body, members[i].first, pose * members[i].own); };
		const Se3r ahead = owner.motion.ahead(step.to - step.from, weight);
		rigid.begin      = at(owner.motion.at);
		rigid.end        = at(ahead);
		rigid.turn       = owner.motion.at.orientation.angularDistance(ahead.orientation);
	}
}

template <int Dim> void Contacts<Dim>::requireAlone(const gimpm::Model<Dim>& model) const
{
	if (model.ghost.workTolerance < 1)
		throw std::invalid_argument(gimpm::sentence(
		        "MpmGhost.workTolerance = ", model.ghost.workTolerance,
		        " cannot go with MpmContact.implicit=True, whose work is not known to it: give 1, or implicit=False."));
	if (model.processes->size() == 1 && model.division->isWhole()) return;
	throw std::invalid_argument(
	        "MpmContact.implicit: several processes do not know a free body that joins nodes of all of them; run in one, or let YADE move it (implicit=False).");
}

template void Contacts<2>::free(Owner&, const Scene&, const gimpm::Grid<2>&);
template void Contacts<3>::free(Owner&, const Scene&, const gimpm::Grid<3>&);
template void Contacts<2>::advanceFree(const StepTime&, bool);
template void Contacts<3>::advanceFree(const StepTime&, bool);
template void Contacts<2>::requireAlone(const gimpm::Model<2>&) const;
template void Contacts<3>::requireAlone(const gimpm::Model<3>&) const;

} // namespace yade
