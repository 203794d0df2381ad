// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/contacts.hpp"
#include "core/terms/contact_in_place.hpp"
#include "engine/conditions/contact_records.hpp"
#include "engine/points/MpmPoint.hpp"
#include "engine/solver/MpmImplicitEngine.hpp"
#include "engine/solver/rigid_bodies.hpp"
#include "yade_api/value_lock.hpp"
#include <algorithm>
#include <map>

namespace yade {

namespace {
	bool hasNewtonIntegrator(const Scene& scene)
	{
		return std::any_of(
		        scene.engines.begin(), scene.engines.end(), [](const auto& e) { return e->getClassName() == "NewtonIntegrator" && !e->dead; });
	}

	Se3r poseOf(const State& state) { return { state.pos, state.ori.normalized() }; }

	// A body that moves with its velocities for some time.
	Se3r moved(const Body& body, const Se3r& from, Real time)
	{
		const State& state = *body.state;
		if (!state.vel.allFinite() || !state.angVel.allFinite())
			throw std::invalid_argument(
			        "Body #" + std::to_string(body.id) + ": its velocities are not finite, and the engine of its contact moves it by them.");
		const Real angle = state.angVel.norm() * time;
		if (angle > 1)
			throw std::invalid_argument(
			        "Body #" + std::to_string(body.id) + " turns by " + std::to_string(angle)
			        + " in one load step; admitted is 1 rad: decrease angVel or O.dt.");
		const Quaternionr turn(Eigen::AngleAxis<Real>(angle, angle > 0 ? Vector3r(state.angVel.normalized()) : Vector3r(Vector3r::UnitX())));
		return { from.position + time * state.vel, (turn * from.orientation).normalized() };
	}

	Real frictionOf(const MpmContact& contact, const Body& body)
	{
		const auto* material = dynamic_cast<const FrictMat*>(body.material.get());
		if (!std::isnan(contact.friction)) return std::tan(contact.friction);
		if (!material || !isFrictionAngle(material->frictionAngle))
			throw std::invalid_argument(
			        "Body #" + std::to_string(body.id) + ": MpmContact.friction is not given, so frictionAngle of its material counts, which "
			        + (material ? "is " + std::to_string(material->frictionAngle) + ": expected radians from 0 to below pi/2."
			                    : "is no FrictMat: give one of them."));
		return std::tan(material->frictionAngle);
	}

	// It is solved with positions of YADE's integrator, and its forces are for that.
	void requireBefore(const string& what, const Scene& scene)
	{
		int reset = -1, self = -1, newton = -1;
		for (size_t i = 0; i < scene.engines.size(); ++i) {
			const string name = scene.engines[i]->getClassName();
			if (name == "ForceResetter") reset = int(i);
			if (dynamic_cast<const MpmImplicitEngine*>(scene.engines[i].get())) self = int(i);
			if (name == "NewtonIntegrator") newton = int(i);
		}
		if (!(reset < self && self < newton))
			throw std::invalid_argument(
			        what
			        + " is free to move and gets the forces of the soil: the engine of its contact must stand behind ForceResetter and before NewtonIntegrator in O.engines.");
	}

	template <int Dim> gimpm::Vec<Dim> headOf(const Vector3r& x) { return x.head<Dim>(); }

	template <int Dim> Vector3r inSpace(const gimpm::Vec<Dim>& x)
	{
		Vector3r result    = Vector3r::Zero();
		result.head<Dim>() = x;
		return result;
	}
}

vector<shared_ptr<Body>> bodiesOf(const MpmContact& contact, const Scene& scene)
{
	vector<shared_ptr<Body>> found;
	const BodyContainer&     all = *scene.bodies;
	for (unsigned id = 0; id < all.size(); ++id) {
		const auto& body = all[id];
		if (!body || !body->shape || !maskMatches(*body, contact.mask) || body->isClump() || dynamic_cast<const MpmPoint*>(body->shape.get())) continue;
		found.push_back(body);
	}
	return found;
}

void handOver(const vector<shared_ptr<MpmContact>>& contacts, Scene& scene)
{
	if (contacts.empty()) return;
	const ValueLock lock;
	for (const auto& contact : contacts)
		contact->handOver(scene);
}

template <int Dim>
Contacts<Dim>::Contacts(
        const vector<shared_ptr<MpmContact>>& contacts, const Scene& scene, const gimpm::Grid<Dim>& grid, const vector<MaterialPoint>& materialPoints,
        bool areDivided, Real begin, Real target)
        : given(contacts), areDivided(areDivided), begin(begin), target(target), end(begin)
{
	if (contacts.empty()) return;
	system    = boost::make_shared<gimpm::ContactSystem<Dim>>();
	yadeMoves = hasNewtonIntegrator(scene);
	for (const auto& contact : contacts)
		add(contact, scene, grid);
	for (const MaterialPoint& point : materialPoints)
		if (!areDivided) points.push_back(point.id);
	for (const auto& contact : contacts)
		recall(*contact);
	std::sort(system->records.begin(), system->records.end(), [](const auto& a, const auto& b) {
		return std::tie(a.point, a.corner, a.body) < std::tie(b.point, b.corner, b.body);
	});
}

template <int Dim> void Contacts<Dim>::add(const shared_ptr<MpmContact>& contact, const Scene& scene, const gimpm::Grid<Dim>& grid)
{
	contact->requireAdmissible();
	const size_t count = members.size();
	Places       known; // of its bodies in the last run
	for (size_t i = 0; i < contact->bodies.size(); ++i)
		known[contact->bodies[i]] = int(i);
	for (const auto& body : bodiesOf(*contact, scene)) {
		if (!body->material)
			throw std::invalid_argument(
			        "Body #" + std::to_string(body->id) + " has no material; MpmContact needs one of bodies that touch the soil.");
		const bool isMember = body->isClumpMember() && scene.bodies->exists(body->clumpId);
		addMember(*contact, body, ownerOf(contact, known, isMember ? *(*scene.bodies)[body->clumpId] : *body, scene), grid);
	}
	if (members.size() == count)
		throw std::invalid_argument(
		        "MpmContact: no body that could touch the soil goes with mask = " + std::to_string(contact->mask)
		        + (Dim == 2 ? ", or none of them has a section at z = 0." : "."));
}

template <int Dim> int Contacts<Dim>::ownerOf(const shared_ptr<MpmContact>& contact, const Places& known, const Body& body, const Scene& scene)
{
	const auto [found, isFirst] = ownersById.try_emplace(body.id, int(owners.size()));
	if (!isFirst) {
		if (owners[found->second].contact == contact) return found->second;
		throw std::invalid_argument(
		        "Body #" + std::to_string(body.id) + " is claimed by two MpmContacts; give them masks that go with different bodies.");
	}
	Owner owner { contact, (*scene.bodies)[body.id], poseOf(*body.state), poseOf(*body.state), {} };
	owner.isFree = yadeMoves && (body.state->blockedDOFs & State::DOF_ALL) != State::DOF_ALL;
	if (owner.isFree && Dim == 2)
		throw std::invalid_argument(
		        "Body #" + std::to_string(body.id)
		        + " is free to move, but on a grid with dim=2 a body is its section, without a mass: prescribe its motion (dynamic=False), or take dim=3.");
	if (owner.isFree) requireBefore("Body #" + std::to_string(body.id), scene);
	const auto former = known.find(body.id);
	owner.isNew       = former == known.end();
	if (!yadeMoves) owner.target = moved(body, owner.begin, target - begin);
	else if (!owner.isNew)
		owner.begin = contact->poseOf(former->second);
	owner.reached = owner.begin;
	owners.push_back(owner);
	system->owners.push_back(headOf<Dim>(owner.begin.position));
	return int(owners.size()) - 1;
}

template <int Dim> void Contacts<Dim>::addMember(const MpmContact& contact, const shared_ptr<Body>& body, int number, const gimpm::Grid<Dim>& grid)
{
	const Owner& owner = owners[number];
	const Se3r   own = inverse(yadeMoves ? owner.target : owner.begin) * poseOf(*body->state), first = owner.begin * own;
	auto         rigid = rigidBody<Dim>(*body, first, grid);
	if (!rigid) return;
	rigid->owner         = number;
	rigid->isNew         = owner.isNew;
	rigid->friction      = frictionOf(contact, *body);
	rigid->adhesion      = contact.adhesion;
	rigid->stiffness     = contact.stiffness;
	const Vector3r shift = owner.target.position - owner.begin.position;
	if ((Dim == 2 && shift[2] != 0) || (grid.axisymmetric && (shift[0] != 0 || !owner.target.orientation.isApprox(owner.begin.orientation, 1e-12))))
		throw std::invalid_argument(
		        "Body #" + std::to_string(owner.body->id) + " moves by (" + std::to_string(shift[0]) + ", " + std::to_string(shift[1]) + ", "
		        + std::to_string(shift[2]) + ") m, or turns: "
		        + (grid.axisymmetric ? "around the axis of symmetry only movement along it is admitted."
		                             : "with dim=2 it can only move in the plane."));
	members.push_back({ body, own, first });
	system->bodies.push_back(*rigid);
}

// What a contact keeps, in numbers of this run.
template <int Dim> void Contacts<Dim>::recall(const MpmContact& contact)
{
	Places numbers;
	for (size_t i = 0; i < members.size(); ++i)
		numbers[members[i].body->id] = int(i);
	forRecords(contact.records, [&](const ContactRecordOfPoint& r) {
		const int  p    = numberOf(r.point);
		const auto body = numbers.find(r.body);
		if (p < 0 || body == numbers.end()) return; // erased
		const auto friction = headOf<Dim>(r.friction), normal = headOf<Dim>(r.normal), place = headOf<Dim>(r.place);
		system->records.push_back({ p, r.corner, body->second, r.offset, r.touches, r.slips, r.gap, r.pressure, friction, normal, place });
	});
}

template <int Dim> void Contacts<Dim>::join(gimpm::Model<Dim>& model)
{
	if (!system) return;
	advanceTo(begin);
	model.terms.push_back([known = system](const gimpm::Beginning<Dim>& step) { return std::make_unique<gimpm::Contact<Dim>>(*known, step); });
	const auto begin = [known = system](const gimpm::PointCloud<Dim>& cloud, Real scale) { shrinkGaps(*known, cloud, scale); };
	model.inPlace.push_back({ begin, [known = system](const gimpm::PointCloud<Dim>& cloud) { keepGaps(*known, cloud); } });
}

template <int Dim> void Contacts<Dim>::advanceTo(Real time)
{
	if (!system) return;
	const auto partAt = [&](Real t) { return target > begin ? std::min(1., (t - begin) / (target - begin)) : 1; };
	for (size_t i = 0; i < owners.size(); ++i) {
		owners[i].reached = between(owners[i].begin, owners[i].target, partAt(time));
		system->owners[i] = headOf<Dim>(owners[i].reached.position);
	}
	for (size_t i = 0; i < members.size(); ++i) {
		auto&        rigid = system->bodies[i];
		const Owner& owner = owners[rigid.owner];
		const auto   at    = [&](const Se3r& pose) { return yade::poseOf<Dim>(*members[i].body, members[i].first, pose * members[i].own); };
		rigid.begin        = at(between(owner.begin, owner.target, partAt(end)));
		rigid.end          = at(owner.reached);
	}
}

template <int Dim> bool Contacts<Dim>::areBeside(const gimpm::Vec<Dim>& point, const gimpm::Vec<Dim>& part) const
{
	return !system || std::none_of(system->bodies.begin(), system->bodies.end(), [&](const auto& body) {
		const auto at = body.proximity(body.end, part, body.sideOf(body.end, point));
		return at.gap < 0 && at.beside < 0;
	});
}

template <int Dim> void Contacts<Dim>::share(const HalvedDomain& domain) const
{
	for (const auto& contact : given)
		shareRecords(*contact, domain);
}

template <int Dim> void Contacts<Dim>::scatter(Real time)
{
	if (!system) return;
	end = time;
	for (const auto& contact : given)
		keep(*contact);
	keepRecords();
	hasKept = true;
	if (yadeMoves) return;
	for (const Owner& owner : owners)
		owner.body->state->se3 = owner.reached;
	for (size_t i = 0; i < members.size(); ++i)
		if (const Owner& owner = owners[system->bodies[i].owner]; owner.body != members[i].body)
			members[i].body->state->se3 = owner.reached * members[i].own;
}

// The impulses are those since the last run.
template <int Dim> void Contacts<Dim>::keep(MpmContact& contact)
{
	std::map<Body::id_t, Vector3r> impulses;
	for (size_t i = 0; i < contact.bodies.size(); ++i)
		impulses[contact.bodies[i]] = hasKept ? contact.impulses[i] : contact.impulsesSince[i];
	contact.forget();
	for (size_t i = 0; i < owners.size(); ++i)
		if (owners[i].contact.get() == &contact) {
			const auto since = impulses.find(owners[i].body->id);
			owners[i].place  = contact.bodies.size();
			contact.keep(
			        owners[i].body->id, system->loads[i], owners[i].reached, owners[i].isFree,
			        since == impulses.end() ? Vector3r(Vector3r::Zero()) : since->second);
		}
}

template <int Dim> void Contacts<Dim>::keepRecords() const
{
	for (const auto& r : system->records) {
		const Owner& owner = owners[system->bodies[r.body].owner];
		MpmContact&  to    = *owner.contact;
		ContactRecordOfPoint { areDivided ? r.point : points[r.point],
			               r.corner,
			               members[r.body].body->id,
			               r.offset,
			               r.gap,
			               r.pressure,
			               r.touches,
			               r.slips,
			               inSpace<Dim>(r.friction),
			               inSpace<Dim>(r.normal),
			               inSpace<Dim>(r.place) }
		        .appendTo(to.records);
		to.touching[owner.place] += r.touches;
		to.slipping[owner.place] += r.slips;
	}
}

template class Contacts<2>;
template class Contacts<3>;

} // namespace yade
