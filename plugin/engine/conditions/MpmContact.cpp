// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/MpmContact.hpp"
#include "engine/conditions/contact_records.hpp"
#include "yade_api/registration.hpp"
#include "yade_api/scene.hpp"

namespace yade {

namespace {
	using Stiffness = Eigen::Matrix<Real, 6, 6>;

	// Translation and turn.
	Eigen::Matrix<Real, 6, 1> movement(const Se3r& before, const State& now)
	{
		const Eigen::AngleAxis<Real> turn(now.ori * before.orientation.conjugate());
		Eigen::Matrix<Real, 6, 1>    result;
		result << now.pos - before.position, turn.angle() * turn.axis();
		return result;
	}
}

void MpmContact::requireAdmissible() const
{
	Exposed<MpmContact, Serializable>::requireAdmissible();
	const size_t n = bodies.size();
	for (const size_t size : { forces.size(), torques.size(), impulses.size(), touching.size(), slipping.size(), areFree.size(), impulsesSince.size(),
	                           poses.size() / 7, stiffnesses.size() / 36 })
		if (size != n) throw std::invalid_argument("MpmContact: what is kept of the bodies does not go together; is the saved file damaged?");
	if (records.size() % ContactRecordOfPoint::width != 0)
		throw std::invalid_argument("MpmContact: what is kept of the points that touch is incomplete; is the saved file damaged?");
}

void MpmContact::forget()
{
	for (auto* list : { &bodies, &touching, &slipping, &areFree })
		list->clear();
	for (auto* list : { &forces, &torques, &impulses, &impulsesSince })
		list->clear();
	for (auto* list : { &poses, &stiffnesses, &records })
		list->clear();
}

void MpmContact::keep(int id, const gimpm::ContactLoad& load, const Se3r& pose, bool isFree, const Vector3r& impulse)
{
	bodies.push_back(id);
	forces.push_back(load.force);
	torques.push_back(load.torque);
	impulses.push_back(impulse);
	impulsesSince.push_back(Vector3r::Zero());
	touching.push_back(0);
	slipping.push_back(0);
	areFree.push_back(isFree);
	poses.insert(poses.end(), pose.position.data(), pose.position.data() + 3);
	poses.insert(poses.end(), pose.orientation.coeffs().data(), pose.orientation.coeffs().data() + 4);
	stiffnesses.insert(stiffnesses.end(), load.stiffness.data(), load.stiffness.data() + load.stiffness.size());
}

Se3r MpmContact::poseOf(size_t i) const
{
	const Real* pose = &poses[7 * i];
	return { Vector3r::Map(pose), Quaternionr(Eigen::Map<const Eigen::Matrix<Real, 4, 1>>(pose + 3)) };
}

void MpmContact::handOver(Scene& scene)
{
	for (size_t i = 0; i < bodies.size(); ++i) {
		if (!areFree[i] || !scene.bodies->exists(bodies[i])) continue;
		const State&                    state = *(*scene.bodies)[bodies[i]]->state;
		const Eigen::Matrix<Real, 6, 1> since = -(Eigen::Map<const Stiffness>(&stiffnesses[36 * i]) * movement(poseOf(i), state));
		scene.forces.addForce(bodies[i], forces[i] + since.head<3>());
		scene.forces.addTorque(bodies[i], torques[i] + since.tail<3>());
		impulsesSince[i] += since.head<3>() * scene.dt;
	}
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmContact)
static const yade::PluginClasses<yade::MpmContact> registeredMpmContact(__FILE__);
