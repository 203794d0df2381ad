// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/contact/MpmContact.hpp"
#include "core/base/sentence.hpp"
#include "core/terms/contact/edges.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/contact/contact_picture.hpp"
#include "engine/conditions/contact/contact_records.hpp"
#include "engine/conditions/contact/contacts.hpp"
#include "engine/conditions/contact/deforming_bodies.hpp"
#include "engine/conditions/contact/free_bodies.hpp"
#include "engine/conditions/contact/rigid_bodies.hpp"
#include "engine/points/MpmPoint.hpp"
#include "yade_api/bodies.hpp"
#include "yade_api/registration.hpp"
#include <set>

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
	Exposed<MpmContact, MpmCondition>::requireAdmissible();
	const size_t n = bodies.size();
	for (const size_t size : { forces.size(), torques.size(), impulses.size(), touching.size(), slipping.size(), areFree.size(), impulsesSince.size(),
	                           poses.size() / 7, stiffnesses.size() / 36 })
		if (size != n) throw std::invalid_argument("MpmContact: the stored data of the bodies do not match; is the saved file damaged?");
	if (turns.size() % turnWidth != 0)
		throw std::invalid_argument("MpmContact: the stored rotations of the bodies are incomplete; is the saved file damaged?");
	if (records.empty()) return;
	if (!ContactRecords::areIn(records))
		throw std::invalid_argument(
		        "MpmContact: the stored contact is that of an earlier revision, by corners of domains, and cannot be used. Give the engine a new one, as solver.contacts = [MpmContact(...)]: "
		        "its bodies begin without force where they are.");
	if (records.size() % ContactRecords::width != 1)
		throw std::invalid_argument("MpmContact: the stored contact points are incomplete; is the saved file damaged?");
}

bool MpmContact::countsSeconds(const Scene& scene) const
{
	const auto all = rigidBodies(scene);
	return std::any_of(all.begin(), all.end(), [](const auto& body) { return !body->state->vel.isZero(0) || !body->state->angVel.isZero(0); });
}

void MpmContact::forget()
{
	for (auto* list : { &bodies, &touching, &slipping, &areFree })
		list->clear();
	for (auto* list : { &forces, &torques, &impulses, &impulsesSince })
		list->clear();
	for (auto* list : { &poses, &stiffnesses, &records, &turns })
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

Matrix3r MpmContact::turnOf(int id) const
{
	for (size_t i = 0; i + turnWidth <= turns.size(); i += turnWidth)
		if (turns[i] == id) return Matrix3r::Map(&turns[i + 1]);
	return Matrix3r::Identity();
}

void MpmContact::keepTurn(int id, const Matrix3r& turn)
{
	if (turn == Matrix3r::Identity()) return;
	turns.push_back(id);
	turns.insert(turns.end(), turn.data(), turn.data() + turn.size());
}

Se3r MpmContact::poseOf(size_t i) const
{
	const Real* pose = &poses[7 * i];
	return { Vector3r::Map(pose), Quaternionr(Eigen::Map<const Eigen::Matrix<Real, 4, 1>>(pose + 3)) };
}

void MpmContact::requireStable(const Body& body, const Stiffness& K, Real dt, bool isHandedOver) const
{
	const Real critical = 2 / std::sqrt(std::max(frequency2(*body.state, K), 1e-300) / (isHandedOver ? 1 : 1 + stiffness));
	if (dt <= critical * (1 + 1e-9)) return;
	throw std::invalid_argument(gimpm::sentence(
	        "Body #", body.id, " of ", body.state->mass, " kg is too light for O.dt = ", dt, " s: contact is a spring of ",
	        K.topLeftCorner<3, 3>().diagonal().maxCoeff(), " N/m to it", isHandedOver ? "" : ", in series with the soil",
	        ", and YADE's integrator is stable up to ", critical, " s. Give a smaller O.dt, a smaller MpmContact.stiffness (", stiffness,
	        "), or a heavier body."));
}

void MpmContact::actOnBodies(Scene& scene, bool isBetween)
{
	for (size_t i = 0; isBetween && i < bodies.size() && scene.dt > stableFor; ++i)
		if (const auto body = bodyAt(scene, bodies[i]); areFree[i] && body)
			requireStable(*body, Eigen::Map<const Stiffness>(&stiffnesses[36 * i]), scene.dt, true);
	stableFor = scene.dt;
	for (size_t i = 0; i < bodies.size(); ++i) {
		const auto body = bodyAt(scene, bodies[i]);
		if (!areFree[i] || !body) continue;
		const State&                    state = *body->state;
		const Eigen::Matrix<Real, 6, 1> since = -(Eigen::Map<const Stiffness>(&stiffnesses[36 * i]) * movement(poseOf(i), state));
		scene.forces.addForce(bodies[i], forces[i] + since.head<3>());
		scene.forces.addTorque(bodies[i], torques[i] + since.tail<3>());
		impulsesSince[i] += since.head<3>() * scene.dt;
	}
}

std::shared_ptr<Condition<2>> MpmContact::make(InPlane, const Group& group, const Analysis&) const { return std::make_shared<Contacts<2>>(group); }
std::shared_ptr<Condition<3>> MpmContact::make(InSpace, const Group& group, const Analysis&) const { return std::make_shared<Contacts<3>>(group); }

vector<shared_ptr<Body>> MpmContact::touchingBodies(const Scene& scene) const
{
	vector<shared_ptr<Body>> found;
	{
		const BodiesLock     lock(scene);
		const BodyContainer& all = *scene.bodies;
		for (unsigned id = 0; id < all.size(); ++id)
			if (const auto& body = all[id];
			    body && body->shape && maskMatches(*body, mask) && !body->isClump() && !dynamic_cast<const MpmPoint*>(body->shape.get()))
				found.push_back(body);
	}
	found.erase(std::remove_if(found.begin(), found.end(), [&](const auto& body) { return isPartOfNet(*body, scene); }), found.end());
	dropSidesOfMembranes(found);
	return found;
}

vector<shared_ptr<Body>> MpmContact::rigidBodies(const Scene& scene) const
{
	vector<shared_ptr<Body>> found = touchingBodies(scene);
	std::set<Body::id_t>     known;
	for (const auto& body : found)
		known.insert(body->id);
	for (size_t i = 0, count = found.size(); i < count; ++i)
		for (const auto& node : nodesOf(*found[i], scene))
			if (known.insert(node->id).second) found.push_back(node);
	return found;
}

namespace {
	template <int Dim> vector<Vector3r> edgesIn(const vector<shared_ptr<Body>>& bodies, const Analysis& analysis, const Scene& scene, Real spacing)
	{
		const auto       lattice  = analysis.grid->lattice<Dim>();
		const Real       duration = scene.dt * analysis.period();
		vector<Vector3r> places;
		for (const Real time : { Real(0), duration }) {
			vector<gimpm::RigidBody<Dim>> rigid;
			for (const auto& body : bodies) {
				if (!nodesOf(*body, scene).empty()) continue; // nets have no edges
				const Se3r now   = poseOf(*body->state);
				auto       found = rigidBody<Dim>(*body, now, lattice);
				if (!found) continue;
				found->begin = poseOf<Dim>(*body, now, ahead(*body->state, now, time));
				rigid.push_back(*found);
			}
			for (const auto& x : gimpm::edgesOf(rigid, spacing, lattice.axisymmetric)) {
				places.push_back(Vector3r::Zero());
				places.back().head<Dim>() = x;
			}
		}
		return places;
	}
}

// A member of a clump moves with its own velocities, which YADE keeps up with the clump's.
vector<Vector3r> MpmContact::edges(const Analysis& analysis, const Scene& scene, Real spacing) const
{
	const auto bodies = touchingBodies(scene);
	return analysis.grid->dim == 2 ? edgesIn<2>(bodies, analysis, scene, spacing) : edgesIn<3>(bodies, analysis, scene, spacing);
}

string MpmContact::idleness(const string& name, bool) const
{
	if (std::any_of(touching.begin(), touching.end(), [](int places) { return places > 0; })) return "";
	return " " + name + " touches nothing yet: a body supports the soil that it touches, and by friction (MpmContact.friction) also along its surface.";
}

// Sums, and of bodies that do not move freely also one by one, but of nodes, of which there are many.
void MpmContact::tell(Rows& rows, const Analysis& analysis, const Listed& listed) const
{
	const int    dim    = analysis.grid->dim;
	const string name   = "contact" + std::to_string(listed.number);
	Vector3r     total  = Vector3r::Constant(bodies.empty() ? std::numeric_limits<Real>::quiet_NaN() : 0);
	int          places = 0;
	const auto   scene  = analysis.ownScene();
	for (size_t b = 0; b < bodies.size(); ++b) {
		total += forces[b];
		places += touching[b];
		const string body   = "body" + std::to_string(bodies[b]);
		const auto   shared = bodyAt(*scene, bodies[b]);
		const bool   isNode = shared && isNodeOfNet(*shared);
		for (int axis = 0; axis < 3 && !areFree[b] && !isNode; ++axis) {
			if (axis < dim) rows.set(body + "_" + "xyz"[axis], forces[b][axis]);
			if (axis == 2 || dim == 3) rows.set(body + "_torque_" + "xyz"[axis], torques[b][axis]);
		}
	}
	rows.setVector(name, total, dim);
	rows.set(name + "_touching", places);
}

void MpmContact::draw(Picture& picture, const Analysis& analysis, const Listed&) const
{
	analysis.grid->dim == 2 ? drawFaces<2>(picture, *this, analysis) : drawFaces<3>(picture, *this, analysis);
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmContact)
static const yade::PluginClasses<yade::MpmContact> registeredMpmContact(__FILE__);
