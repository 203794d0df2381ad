// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/contact/contacts.hpp"
#include "core/base/sentence.hpp"
#include "core/structures/rigid_lines.hpp"
#include "core/structures/rigid_sheets.hpp"
#include "core/terms/contact/contact.hpp"
#include "core/terms/inertia/motion.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/contact/rigid_bodies.hpp"
#include "engine/conditions/contact/rolling.hpp"
#include "engine/conditions/contact/small_features.hpp"
#include "engine/conditions/flow/MpmFlow.hpp"
#include "engine/conditions/structures/MpmBeam.hpp"
#include "engine/conditions/structures/parting.hpp"
#include "yade_api/bodies.hpp"
#include <algorithm>
#include <map>

namespace yade {

namespace {

	// The same of one that the engine moves.
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
		return ahead(state, from, time);
	}

	// A coefficient of 1 is given for rough bodies, and is no usual angle.
	string warningOfAngle(const string& name, Real angle)
	{
		const bool isRound = std::abs(1e3 * angle - std::round(1e3 * angle)) < 1e-9;
		if (!(angle > M_PI / 4) || !isRound) return "";
		return gimpm::sentence(
		        name, " = ", angle, " is an angle in radians, ", angle * 180 / M_PI, " degrees; was a coefficient meant, that is atan(", angle,
		        "), or an angle in degrees, that is radians(...)?");
	}

	// Its coefficient, and a doubt about the angle.
	Real frictionOf(const MpmContact& contact, const Body& body, string& warning)
	{
		const auto* material = dynamic_cast<const FrictMat*>(body.material.get());
		if (warning.empty() && !std::isnan(contact.friction)) warning = warningOfAngle("MpmContact.friction", contact.friction);
		if (!std::isnan(contact.friction)) return std::tan(contact.friction);
		if (!material || !isFrictionAngle(material->frictionAngle))
			throw std::invalid_argument(
			        "Body #" + std::to_string(body.id) + ": MpmContact.friction is not given, so frictionAngle of its material counts, which "
			        + (material ? "is " + std::to_string(material->frictionAngle) + ": expected radians from 0 to below pi/2."
			                    : "is no FrictMat: give one of them."));
		if (warning.empty()) warning = warningOfAngle("frictionAngle of the material of body #" + std::to_string(body.id), material->frictionAngle);
		return std::tan(material->frictionAngle);
	}

	bool areSame(const Se3r& a, const State& state) { return a.position == state.pos && a.orientation.coeffs() == state.ori.coeffs(); }

	void requireSmallTurn(const Body& body, const Se3r& before, const Se3r& after)
	{
		const Real angle = before.orientation.angularDistance(after.orientation);
		if (angle > 1)
			throw std::invalid_argument(gimpm::sentence(
			        "Body #", body.id, " has been turned by ", angle,
			        " rad since the last load step, by its state.ori and angVel together; admitted is 1 rad: turn it in more steps."));
	}

	Real angleBetween(const Se3r& a, const Se3r& b) { return a.orientation.angularDistance(b.orientation); }

	template <int Dim> gimpm::Vec<Dim> headOf(const Vector3r& x) { return x.head<Dim>(); }

	// Features that do not go with soil parted by thin bodies; empty: nothing.
	string cannotPart(const Analysis& analysis, int processes)
	{
		if (processes > 1) return "several processes";
		for (const Listed& listed : analysis.conditions())
			if (listed.condition->partsBodies() || dynamic_cast<const MpmBeam*>(listed.condition.get())) return listed.name();
		return obstacleToParting(analysis);
	}
}

template <int Dim> Contacts<Dim>::Contacts(const MpmCondition::Group& group) : system(new gimpm::ContactSystem<Dim>)
{
	for (const Listed& listed : group)
		given.push_back(boost::static_pointer_cast<MpmContact>(listed.condition));
}

template <int Dim> Contacts<Dim>::~Contacts()
{
	vector<shared_ptr<Body>> bodies;
	for (Owner& owner : owners)
		bodies.push_back(std::move(owner.body));
	for (Member& member : members)
		bodies.push_back(std::move(member.body));
	if (scene) release(std::move(bodies), *scene);
}

template <int Dim> void Contacts<Dim>::add(const shared_ptr<MpmContact>& contact, const Scene& scene, const gimpm::Grid<Dim>& grid)
{
	const size_t count = members.size();
	Places       known; // numbers of its bodies in the last run
	for (size_t i = 0; i < contact->bodies.size(); ++i)
		known[contact->bodies[i]] = int(i);
	for (const auto& body : contact->touchingBodies(scene)) {
		if (!body->material)
			throw std::invalid_argument(
			        "Body #" + std::to_string(body->id) + " has no material; MpmContact needs one of bodies that touch the soil.");
		if (!nodesOf(*body, scene).empty()) {
			addDeforming(contact, known, body, scene, grid);
			continue;
		}
		const auto clump = body->isClumpMember() ? bodyAt(scene, body->clumpId) : nullptr;
		addMember(*contact, body, ownerOf(contact, known, clump ? clump : body, scene, grid), grid);
	}
	if (members.size() == count)
		throw std::invalid_argument(
		        "MpmContact: no body that could touch the soil goes with mask = " + std::to_string(contact->mask)
		        + (Dim == 2 ? ", or none of them has a section at z = 0." : "."));
}

template <int Dim>
int Contacts<Dim>::ownerOf(
        const shared_ptr<MpmContact>& contact, const Places& known, const shared_ptr<Body>& shared, const Scene& scene, const gimpm::Grid<Dim>& grid)
{
	const Body& body            = *shared;
	const auto [found, isFirst] = ownersById.try_emplace(body.id, int(owners.size()));
	if (!isFirst) {
		if (owners[found->second].contact == contact) return found->second;
		throw std::invalid_argument(
		        "Body #" + std::to_string(body.id) + " is claimed by two MpmContacts; give them masks that go with different bodies.");
	}
	const Se3r now = poseOf(*body.state);
	Owner      owner { contact, shared, now, now, now, {}, {} };
	owner.byYade             = movers->move(body);
	const bool isConstrained = (body.state->blockedDOFs & State::DOF_ALL) == State::DOF_ALL;
	if (contact->implicit && !isConstrained) free(owner, scene, grid);
	owner.isFree = owner.free < 0 && owner.byYade && (body.state->blockedDOFs & State::DOF_ALL) != State::DOF_ALL;
	if (owner.isFree && Dim == 2)
		throw std::invalid_argument(
		        "Body #" + std::to_string(body.id)
		        + " is free to move, but on a grid with dim=2 a body is its section, which YADE has no mass of: let the engine move it (MpmContact.implicit=True), prescribe its motion (dynamic=False), or take dim=3.");
	if (owner.isFree) requireExchange(body, scene);
	const auto former = known.find(body.id);
	owner.isNew       = former == known.end();
	if (owner.free < 0 && !owner.byYade) owner.target = moved(body, owner.given, target - begin);
	if (owner.isFree && inTime) owner.target = ahead(*body.state, now, target - begin - dt);
	owner.byScript = owner.free < 0 && !owner.isNew && !owner.byYade && !areSame(contact->poseOf(former->second), *body.state);
	if (owner.byScript || (!owner.isNew && owner.byYade)) owner.begin = contact->poseOf(former->second);
	if (owner.byScript) requireSmallTurn(body, owner.begin, owner.target);
	owner.reached = owner.begin;
	owners.push_back(owner);
	system->owners.push_back(headOf<Dim>(owner.begin.position));
	return int(owners.size()) - 1;
}

// A script that moves a clump by state.pos has to move its members, too, as YADE does.
template <int Dim> void Contacts<Dim>::requireTogether(const MpmContact& contact, const Body& body, const Owner& owner, const Se3r& own) const
{
	constexpr Real roundOff = 1e-7;
	const auto     known    = contact.ownPoses.find(body.id);
	if (owner.body->id == body.id || known == contact.ownPoses.end()) return;
	const Se3r& before = known->second;
	if ((own.position - before.position).norm() <= roundOff * (1 + own.position.norm()) && angleBetween(own, before) <= roundOff) return;
	throw std::invalid_argument(gimpm::sentence(
	        "Body #", body.id, ", a member of clump #", owner.body->id,
	        ", is not where it was in the clump: one of them has been moved without the other. Move the clump by its state.vel and angVel, or move it and all members alike."));
}

template <int Dim> void Contacts<Dim>::addMember(const MpmContact& contact, const shared_ptr<Body>& body, int number, const gimpm::Grid<Dim>& grid)
{
	const Owner& owner = owners[number];
	const Se3r   own = inverse(owner.given) * poseOf(*body->state), first = owner.begin * own;
	requireTogether(contact, *body, owner, own);
	auto rigid = rigidBody<Dim>(*body, first, grid);
	if (!rigid) return;
	rigid->shape.axes    = contact.turnOf(body->id).topLeftCorner<Dim, Dim>();
	rigid->turn          = std::max(angleBetween(owner.begin, owner.target), owner.byYade ? owner.body->state->angVel.norm() * (target - begin) : 0);
	const Vector3r shift = owner.target.position - owner.begin.position;
	if ((Dim == 2 && shift[2] != 0) || (grid.axisymmetric && (shift[0] != 0 || !owner.target.orientation.isApprox(owner.begin.orientation, 1e-12))))
		throw std::invalid_argument(
		        "Body #" + std::to_string(owner.body->id) + " moves by (" + std::to_string(shift[0]) + ", " + std::to_string(shift[1]) + ", "
		        + std::to_string(shift[2]) + ") m, or turns: "
		        + (grid.axisymmetric ? "around the axis of symmetry only movement along it is admitted."
		                             : "with dim=2 it can only move in the plane."));
	add(contact, *rigid, { body, own, unturned(*body, first, grid) }, number);
}

template <int Dim> void Contacts<Dim>::add(const MpmContact& contact, gimpm::RigidBody<Dim> rigid, const Member& member, int number)
{
	rigid.owner               = number;
	rigid.free                = owners[number].free;
	rigid.isNew               = owners[number].isNew;
	rigid.frictionCoefficient = frictionOf(contact, *member.body, coefficient);
	rigid.adhesion            = contact.adhesion;
	rigid.stiffness           = contact.stiffness;
	members.push_back(member);
	system->bodies.push_back(rigid);
}

// A body that deforms with its nodes, which are the owners.
template <int Dim>
void Contacts<Dim>::addDeforming(
        const shared_ptr<MpmContact>& contact, const Places& known, const shared_ptr<Body>& body, const Scene& scene, const gimpm::Grid<Dim>& grid)
{
	Member member { body, {}, {} };
	for (const auto& node : nodesOf(*body, scene))
		member.nodes.push_back(ownerOf(contact, known, node, scene, grid));
	for (const int node : member.nodes)
		if (owners[node].free >= 0)
			throw std::invalid_argument(gimpm::sentence(
			        "MpmContact.implicit: body #", owners[node].body->id, " is a node of body #", body->id, ", a ", body->shape->getClassName(),
			        ", and free: nets are moved by YADE, which knows what holds them together. Give them an MpmContact of their own, with implicit=False."));
	auto deforming = deformingBody<Dim>(*body, grid, nodePoses(member));
	for (size_t i = 0; i < member.nodes.size(); ++i)
		deforming.nodeOwners[i] = member.nodes[i];
	add(*contact, deforming, member, member.nodes[0]);
}

// At the begin and the end of the step.
template <int Dim> vector<NodePose> Contacts<Dim>::nodePoses(const Member& member) const
{
	vector<NodePose> poses;
	for (const int i : member.nodes)
		poses.push_back({ owners[i].body.get(), between(owners[i].begin, owners[i].target, partAt(end)), owners[i].reached });
	return poses;
}

template <int Dim> void Contacts<Dim>::join(gimpm::Model<Dim>& model, const Surroundings<Dim>& around)
{
	begin = end = around.begin, target = around.target, dt = around.scene.dt;
	ofGravity = around.analysis.curveOfGravity(), gravity = around.analysis.gravity, isExplicit = around.analysis.isExplicit();
	cellSize = model.grid.cellSize, scene = &around.scene;
	inItsWay = cannotPart(around.analysis, model.processes->size());
	inTime   = around.analysis.isDynamic();
	hasFlow  = bool(MpmFlow::of(around.analysis));
	for (const auto& material : model.materials)
		soil.density = std::max(soil.density, material.density);
	soil.cellSize = cellSize, soil.answers = !around.analysis.isExplicit();
	movers.emplace(around.scene);
	for (const auto& contact : given)
		add(contact, around.scene, model.grid);
	for (const auto& contact : given)
		recall(*contact);
	system->sortRecords();
	advanceTo(begin);
	if (!system->free.empty()) {
		requireAlone(model);
		model.coupledTerms.push_back([known = system](const gimpm::StepContext<Dim>&, const gimpm::State&) {
			return std::make_unique<gimpm::ContactCoupling<Dim>>(*known);
		});
	}
	if (!inTime && model.division->isWhole()) distance = warningOfDistance(around.cloud); // in time soil may come by itself
	model.terms.push_back([known = system](const gimpm::StepContext<Dim>& step) { return std::make_unique<gimpm::Contact<Dim>>(*known, step); });
	const auto shrink = [known = system](const gimpm::PointCloud<Dim>&, Real scale) {
		for (auto& record : known->records)
			record.gap *= scale;
	};
	model.inPlace.push_back({ shrink, [](const gimpm::PointCloud<Dim>&) {} });
}

template <int Dim> void Contacts<Dim>::joinMotion(gimpm::Motion<Dim>& motion, const gimpm::Model<Dim>&, Real)
{
	system->weight = motion.scheme.weightOfContact();
	for (Owner& owner : owners)
		owner.motion.part = motion.scheme.atMiddle ? 0.5 : motion.scheme.isAlpha() ? 1 - motion.scheme.alphaF : motion.scheme.gamma;
	motion.contacts = system.get();
}

template <int Dim> void Contacts<Dim>::part(gimpm::PointCloud<Dim>& cloud, gimpm::Model<Dim>& model)
{
	advanceTo(end);
	if constexpr (Dim == 2) partBy(gimpm::linesOf(system->bodies, model.grid), cloud, model.grid);
	else
		partBy(gimpm::sheetsOf(system->bodies, model.grid), cloud, model.grid);
}

// Parts the soil by lines or surfaces of thin bodies.
template <int Dim> template <class Surface> void Contacts<Dim>::partBy(vector<Surface> surfaces, gimpm::PointCloud<Dim>& cloud, gimpm::Grid<Dim>& grid)
{
	vector<std::conditional_t<Dim == 2, gimpm::PartingLine, gimpm::PartingSheet>*> those;
	for (auto& surface : surfaces)
		those.push_back(&surface);
	if (inItsWay.empty()) gimpm::partSoil(those, cloud, grid, true);
	else
		gimpm::lookBetween(those, cloud, grid);
	for (const auto& surface : surfaces)
		for (const int body : surface.bodies)
			system->bodies[body].isBetween = surface.isBetween, system->bodies[body].parts = surface.layer > 0, requirePermeable(body);
}

// Water would go through a thin body that does not part the soil.
template <int Dim> void Contacts<Dim>::requirePermeable(int body) const
{
	const auto& rigid = system->bodies[body];
	if (!hasFlow || inItsWay.empty() || !rigid.isBetween || rigid.parts) return;
	throw std::invalid_argument(gimpm::sentence(
	        rigid.name, ", thinner than a cell: the soil on its two sides is one body, because of ", inItsWay,
	        ", and water of MpmFlow would pass it as if there were none. Leave one of the two out."));
}

template <int Dim> void Contacts<Dim>::advance(const StepTime& step, gimpm::Model<Dim>& model, gimpm::Load<Dim>& load)
{
	advanceTo(step.to);
	advanceFree(step, model.grid.axisymmetric);
	system->kind = step.kind, system->energy = step.energy;
	load.motion = step.to - step.from;
}

template <int Dim> void Contacts<Dim>::advanceTo(Real time)
{
	for (size_t i = 0; i < owners.size(); ++i) {
		if (owners[i].free >= 0) continue;
		owners[i].reached = between(owners[i].begin, owners[i].target, partAt(time));
		system->owners[i] = headOf<Dim>(owners[i].reached.position);
	}
	for (size_t i = 0; i < members.size(); ++i) {
		auto&        rigid = system->bodies[i];
		const Owner& owner = owners[rigid.owner];
		if (owner.free >= 0) continue;
		if (!members[i].nodes.empty()) {
			deform(rigid, nodePoses(members[i]));
			continue;
		}
		const auto at = [&](const Se3r& pose) { return yade::poseOf<Dim>(*members[i].body, members[i].first, pose * members[i].own); };
		rigid.begin   = at(between(owner.begin, owner.target, partAt(end)));
		rigid.end     = at(owner.reached);
	}
}

template <int Dim> Work Contacts<Dim>::work(const StepOutcome<Dim>&) const { return workOf(*system); }

template <int Dim> Penalty Contacts<Dim>::penalty() const
{
	Penalty largest { 0, "smaller MpmContact.stiffness" };
	for (const auto& contact : given)
		largest.size = std::max(largest.size, contact->stiffness);
	return largest;
}

template <int Dim> bool Contacts<Dim>::areBeside(const gimpm::Vec<Dim>& point, const gimpm::Vec<Dim>& part) const
{
	return std::none_of(system->bodies.begin(), system->bodies.end(), [&](const auto& body) {
		const auto at = body.proximity(body.end, part, body.sideOf(body.end, point));
		return at.gap < 0 && at.beside < 0;
	});
}

template <int Dim> void Contacts<Dim>::reach(const StepOutcome<Dim>& step)
{
	const Real time = step.time;
	end             = time;
	for (Owner& owner : owners) {
		if (owner.free < 0) continue;
		follow<Dim>(owner.motion, system->free[owner.free], time - step.from);
		owner.reached = owner.motion.at;
	}
	addToMeans((time - step.from) / (target - begin));
	for (const auto& contact : given)
		keep(*contact);
	keepRecords();
	hasKept = true;
	// The pose stays where a script has put the body: the rest of that way is made by the next step.
	for (const Owner& owner : owners) {
		if (owner.byYade) continue;
		const bool isLate = owner.byScript && partAt(time) < 1;
		if (owner.free >= 0 && inTime) owner.body->state->vel = owner.motion.velocity, owner.body->state->angVel = owner.motion.spin;
		owner.body->state->se3 = isLate ? between(owner.given, owner.target, partAt(time)) : owner.reached;
	}
	for (size_t i = 0; i < members.size(); ++i) {
		if (!members[i].nodes.empty()) continue;
		const Owner& owner                           = owners[system->bodies[i].owner];
		owner.contact->ownPoses[members[i].body->id] = members[i].own;
		if (!owner.byYade && owner.body != members[i].body) members[i].body->state->se3 = owner.body->state->se3 * members[i].own;
	}
}

// Load of a free body until the next load step: the impulse that the soil has got in this one.
template <int Dim> void Contacts<Dim>::addToMeans(Real part)
{
	for (size_t i = 0; inTime && i < owners.size(); ++i)
		owners[i].mean.force += part * system->loads[i].force, owners[i].mean.torque += part * system->loads[i].torque;
}

template <int Dim> void Contacts<Dim>::requireKept() const
{
	for (size_t i = 0; i < owners.size(); ++i)
		if (owners[i].isFree && inTime && isBetween()) requirePeriod(*owners[i].body, system->loads[i], soil, dt, target - begin);
		else if (owners[i].isFree)
			owners[i].contact->requireStable(*owners[i].body, system->loads[i].stiffness, dt, isBetween());
}

template <int Dim> string Contacts<Dim>::warningOfDistance(const gimpm::PointCloud<Dim>& cloud) const
{
	constexpr Real far   = 10; // cells
	const auto     stays = [](const Owner& owner) {
                return owner.isNew && !owner.byYade && angleBetween(owner.begin, owner.target) < 1e-7 && owner.begin.position == owner.target.position;
	};
	if (cloud.size() == 0 || !std::all_of(owners.begin(), owners.end(), stays)) return "";
	gimpm::Vec<Dim> low = cloud.position[0], high = low;
	for (size_t p = 0; p < cloud.size(); ++p)
		low = low.cwiseMin(cloud.position[p] - cloud.halfSize[p]), high = high.cwiseMax(cloud.position[p] + cloud.halfSize[p]);
	Real                         least   = std::numeric_limits<Real>::infinity();
	const gimpm::RigidBody<Dim>* nearest = nullptr;
	for (const auto& body : system->bodies) {
		const auto [from, to] = body.bounds(body.begin);
		const Real away       = (from - high).cwiseMax(low - to).cwiseMax(0).norm();
		if (away < least) least = away, nearest = &body;
	}
	if (!nearest || !(least > far * cellSize)) return "";
	return gimpm::sentence(
	        nearest->name, " is ", least, " m away from the soil, more than ", far,
	        " cells, and is the nearest one that MpmContact has; none of them moves. Is it where it is meant to be, and does MpmContact.mask name the bodies that are meant?");
}

template <int Dim> std::map<string, string> Contacts<Dim>::warnings() const
{
	std::map<string, string> found;
	found["coefficient"] = coefficient;
	found["distance"]    = distance;
	found["thin"]        = warningOfSmallFeatures(*system, cellSize, inItsWay);
	for (size_t i = 0; i < owners.size() && !inTime; ++i)
		if (owners[i].isFree && found["rolls"].empty()) found["rolls"] = warningOfRolling<Dim>(*owners[i].body, *system, int(i), cellSize);
	return found;
}

template class Contacts<2>;
template class Contacts<3>;

} // namespace yade
