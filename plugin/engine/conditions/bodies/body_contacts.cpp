// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/bodies/body_contacts.hpp"
#include "core/base/sentence.hpp"
#include "core/grid/cells_around.hpp"
#include "core/grid/folds.hpp"
#include "core/terms/inertia/motion.hpp"
#include "engine/conditions/bodies/bodies_past.hpp"
#include "engine/conditions/bodies/layers.hpp"
#include "engine/conditions/flow/MpmFlow.hpp"
#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

namespace yade {

template <int Dim>
MeetingBodies<Dim>::MeetingBodies(const MpmCondition::Group& group, const Analysis& analysis)
        : analysis(analysis), grid(*analysis.grid), system(new gimpm::BodyContacts<Dim>)
{
	for (const Listed& listed : group)
		given.push_back(boost::static_pointer_cast<MpmBodyContact>(listed.condition));
}

template <int Dim> void MeetingBodies<Dim>::hold(gimpm::Model<Dim>& model)
{
	layers = bodyLayers(analysis);
	for (size_t body = 0; body < grid.bodies.size(); ++body)
		if (layers[body + 1] > gimpm::Grid<Dim>::mostLayer)
			throw std::invalid_argument(gimpm::sentence(
			        "contacts: more than ", gimpm::Grid<Dim>::mostLayer + 1,
			        " bodies of points with nodes of their own, as those in contact with each other or named by a condition, as body '",
			        grid.bodies[body]->name, "' is, cannot be numbered."));
	model.layers = layers;
}

// The softer one of both, which is asked once; of equal ones the first.
template <int Dim> int MeetingBodies<Dim>::slaveOf(const MpmBodyContact& contact, const Surroundings<Dim>& around, const gimpm::Model<Dim>& model) const
{
	if (contact.slave >= 0) return contact.slave;
	if (contact.isOfOne()) return 0;
	Real        modulus[2] {}, volume[2] {};
	const auto& cloud = around.cloud;
	for (size_t p = 0; p < around.points.size(); ++p)
		for (int side = 0; side < 2; ++side) {
			if (around.points[p].state->body != grid.bodyNamed(contact.between[side])) continue;
			const auto strain = [&] { return cloud.elasticStrain[p].full().trace(); };
			modulus[side] += cloud.volume0[p] * model.materials[cloud.material[p]].young(cloud.parameters, cloud.internals, int(p), strain);
			volume[side] += cloud.volume0[p];
		}
	for (int side = 0; side < 2; ++side)
		modulus[side] = model.division->sum(modulus[side]), volume[side] = model.division->sum(volume[side]);
	for (int side = 0; side < 2; ++side)
		if (volume[side] == 0)
			throw std::invalid_argument(
			        "MpmBodyContact.between: body '" + contact.between[side] + "' has no points in the scene: append what mpm.fill(..., body='"
			        + contact.between[side] + "') returns to O.bodies.");
	return modulus[1] / volume[1] < (1 - 1e-9) * (modulus[0] / volume[0]) ? 1 : 0;
}

// Pairs of bodies in different layers, as both are in contact with a third one or a condition names one, and without a
// contact.
template <int Dim> std::set<std::pair<int, int>> MeetingBodies<Dim>::apart(const vector<MaterialPoint>& points, const gimpm::Division& division) const
{
	std::int64_t areAllNamed = std::all_of(points.begin(), points.end(), [](const MaterialPoint& point) { return point.state->body >= 0; });
	division.smallest(&areAllNamed, 1);
	std::set<std::pair<int, int>> pairs;
	for (int one = areAllNamed ? 0 : -1; one < int(grid.bodies.size()); ++one)
		for (int other = one + 1; other < int(grid.bodies.size()); ++other)
			if (layers[one + 1] != layers[other + 1] && !meet(analysis, one, other)) pairs.insert({ one, other });
	return pairs;
}

namespace {
	struct BodyInCell {
		gimpm::Key   cell;
		std::int64_t body;

		bool operator<(const BodyInCell& other) const { return std::pair(cell, body) < std::pair(other.cell, other.body); }
		bool operator==(const BodyInCell& other) const { return cell == other.cell && body == other.body; }
	};

	// Bodies with points in a cell of the largest size, by cell, for the points of all processes.
	template <int Dim> std::unordered_map<gimpm::Key, std::set<int>> bodiesByCell(const vector<MaterialPoint>& points, const gimpm::Model<Dim>& model)
	{
		vector<BodyInCell> own;
		for (const MaterialPoint& point : points) {
			const gimpm::Vec<Dim> x = (point.state->pos.template head<Dim>() - model.grid.origin) / gimpm::largestCell(model.grid);
			own.push_back({ gimpm::Grid<Dim>::key(x.array().floor().template cast<int>()), point.state->body });
		}
		std::sort(own.begin(), own.end());
		own.erase(std::unique(own.begin(), own.end()), own.end());
		std::unordered_map<gimpm::Key, std::set<int>> bodies;
		for (const auto& [cell, body] : model.division->joined(std::move(own)))
			bodies[cell].insert(int(body));
		return bodies;
	}
}

// Bodies that would go through each other.
template <int Dim> void MeetingBodies<Dim>::requireNoneBetween(const vector<MaterialPoint>& points, const gimpm::Model<Dim>& model) const
{
	const auto pairs = apart(points, *model.division);
	if (pairs.empty()) return;
	const auto bodiesIn = bodiesByCell(points, model);
	for (const auto& [key, bodies] : bodiesIn)
		for (int n = 0; n < gimpm::cellsAround<Dim>; ++n) {
			const gimpm::Index<Dim> cell = gimpm::Grid<Dim>::index(key) + gimpm::offsetAround<Dim>(n);
			const auto              near = bodiesIn.find(gimpm::Grid<Dim>::key(cell));
			if (near == bodiesIn.end()) continue;
			for (const int one : bodies)
				for (const int other : near->second)
					if (pairs.count({ one, other }))
						throw std::invalid_argument(gimpm::sentence(
						        "contacts: bodies of points ", nameOf(one), " and ", nameOf(other), " are in neighbouring cells at (",
						        (model.grid.origin + gimpm::largestCell(model.grid) * cell.template cast<double>()).transpose(),
						        ") and have no MpmBodyContact between them; they cannot stick, as a contact of one of them, or a condition that names it (body), parts it from what the other one sticks to. Give them one, with friction."));
		}
}

// Refuses a body without a surface where no other is in contact with it.
template <int Dim> gimpm::MeetingBody<Dim> MeetingBodies<Dim>::coreBody(int number) const
{
	const MpmBody&          from = *grid.bodies[number];
	gimpm::MeetingBody<Dim> body { from.name, layers[number + 1], {} };
	for (const Vector3r& x : from.vertices)
		body.surface.vertices.push_back(x.head<Dim>());
	for (const Vector3r& x : from.initialVertices.empty() ? from.vertices : from.initialVertices)
		body.surface.vertices0.push_back(x.head<Dim>());
	const bool isMet = std::any_of(given.begin(), given.end(), [&](const auto& contact) {
		return std::find(contact->between.begin(), contact->between.end(), grid.nameOfWhole(number)) != contact->between.end();
	});
	for (size_t i = 0; isMet && i < from.pieces.size(); ++i) {
		body.surface.pieces.emplace_back();
		std::copy(from.pieces[i].begin(), from.pieces[i].end(), body.surface.pieces.back().begin());
	}
	if (from.initialVertices.empty()) body.divideRectangles(grid.smallestCell());
	body.refine(grid.smallestCell());
	return body;
}

template <int Dim> gimpm::BodyMeeting<Dim> MeetingBodies<Dim>::coreMeeting(const MpmBodyContact& contact, ContactRecord record) const
{
	gimpm::BodyMeeting<Dim> meeting;
	meeting.slave = record.slave, meeting.master = record.master, meeting.isOfOne = contact.isOfOne();
	meeting.frictionCoefficient = std::tan(contact.friction);
	meeting.adhesion            = contact.adhesion;
	meeting.stiffness           = contact.stiffness;
	meeting.isFilled            = contact.filled;
	meeting.touching = contact.touching, meeting.slipping = contact.slipping;
	if (record.shears.size() != system->bodies[meeting.slave].surface.pieces.size()) return meeting;
	meeting.pressure = std::move(record.pressures);
	for (const Vector3r& shear : record.shears)
		meeting.shear.push_back(shear.head<Dim>());
	return meeting;
}

// One for each pair of parts of the two bodies.
template <int Dim> void MeetingBodies<Dim>::addMeetings(int number, Real leakage)
{
	const MpmBodyContact& contact = *given[number];
	const auto            records = recordsOf(contact, grid);
	for (const auto& [first, second] : pairsOf(contact, grid)) {
		ContactRecord record { contact.slave == 0 ? first : second, contact.slave == 0 ? second : first };
		for (const ContactRecord& kept : records)
			if (kept.slave == record.slave && kept.master == record.master) record = kept;
		contactOf.push_back(number);
		system->meetings.push_back(coreMeeting(contact, std::move(record)));
		system->meetings.back().leakage = leakage;
	}
}

// Leakage of a meeting; where water passes as in soil, by what conducts least in the two bodies.
template <int Dim> Real MeetingBodies<Dim>::leakageOf(const MpmBodyContact& contact, const Surroundings<Dim>& around, const gimpm::Division& division) const
{
	const auto flow = MpmFlow::of(analysis);
	if (!flow) return 0;
	if (std::isfinite(contact.permittivity)) return contact.permittivity / flow->unitWeight;
	const int one = grid.bodyNamed(contact.between[0]), other = grid.bodyNamed(contact.between[1]);
	Real      least = std::numeric_limits<Real>::infinity();
	for (const MaterialPoint& point : around.points) {
		if (point.state->body != one && point.state->body != other) continue;
		const Real* own = point.state->parameter("conductivity");
		least           = std::min(least, own ? *own : point.material->conductivity.horizontal);
	}
	least = -division.largest(-least);
	return gimpm::conductanceOfSoil * least / grid.smallestCell() / flow->unitWeight;
}

template <int Dim> void MeetingBodies<Dim>::join(gimpm::Model<Dim>& model, const Surroundings<Dim>& around)
{
	requireNoneBetween(around.points, model);
	requireNonePast(around.points, model, analysis, layers);
	for (size_t b = 0; b < grid.bodies.size(); ++b)
		system->bodies.push_back(coreBody(int(b)));
	if (model.processes->size() > 1 && std::any_of(given.begin(), given.end(), [](const auto& contact) { return contact->folds; }))
		throw std::invalid_argument("MpmBodyContact.folds = True does not go with several processes yet; leave it out, or run in one.");
	for (size_t i = 0; i < given.size(); ++i) {
		given[i]->slave = slaveOf(*given[i], around, model);
		addMeetings(int(i), leakageOf(*given[i], around, *model.division));
	}
	model.coupledTerms.push_back([known = system](const gimpm::StepContext<Dim>& step, const gimpm::State& begin) {
		return std::make_unique<gimpm::BodyContact<Dim>>(*known, step, begin);
	});
}

template <int Dim> void MeetingBodies<Dim>::joinMotion(gimpm::Motion<Dim>& motion, const gimpm::Model<Dim>&, Real)
{
	system->weight = motion.scheme.weightOfContact();
	motion.bodies  = system.get();
}

template <int Dim> void MeetingBodies<Dim>::part(gimpm::PointCloud<Dim>& cloud, gimpm::Model<Dim>& model)
{
	std::map<int, gimpm::FoldingBody<Dim>> folding;
	for (const auto& meeting : system->meetings)
		if (meeting.slave == meeting.master)
			folding[meeting.slave] = { system->bodies[meeting.slave].layer, &system->bodies[meeting.slave].surface, meeting.pressure };
	if (folding.empty()) return;
	vector<gimpm::FoldingBody<Dim>> bodies;
	for (const auto& [number, body] : folding)
		bodies.push_back(body);
	int bits = 0; // of the layers of bodies
	while (*std::max_element(layers.begin(), layers.end()) > bits)
		bits = 2 * bits + 1;
	gimpm::partFolds(bodies, bits, cloud, model.grid);
	size_t next = 0;
	for (const auto& [number, body] : folding)
		system->bodies[number].layerOfPiece = bodies[next++].layerOfPiece;
}

template <int Dim> void MeetingBodies<Dim>::advance(const StepTime& step, gimpm::Model<Dim>&, gimpm::Load<Dim>&)
{
	system->kind = step.kind, system->energy = step.energy, system->duration = step.to - step.from;
}

template <int Dim> Work MeetingBodies<Dim>::work(const StepOutcome<Dim>&) const { return workOf(*system); }

template <int Dim> void MeetingBodies<Dim>::reach(const StepOutcome<Dim>&)
{
	for (size_t b = 0; b < grid.bodies.size(); ++b) {
		const auto& surface = system->bodies[b].surface;
		MpmBody&    to      = *grid.bodies[b];
		if (surface.pieces.empty()) continue;
		const auto inSpace = [z = to.vertices.front()[2]](const std::vector<gimpm::Vec<Dim>>& points) {
			vector<Vector3r> result;
			for (const auto& x : points) {
				result.emplace_back(0, 0, z);
				result.back().template head<Dim>() = x;
			}
			return result;
		};
		to.vertices        = inSpace(surface.vertices);
		to.initialVertices = inSpace(surface.vertices0);
		to.pieces.clear();
		for (const auto& piece : surface.pieces)
			to.pieces.emplace_back(piece.begin(), piece.end());
	}
	for (size_t i = 0; i < given.size(); ++i)
		keep(int(i));
}

// Writes results of the last step to a contact.
template <int Dim> void MeetingBodies<Dim>::keep(int number)
{
	MpmBodyContact&       to   = *given[number];
	const Real            sign = to.slave == 0 ? 1 : -1;
	vector<ContactRecord> records;
	to.force.setZero(), to.moment.setZero();
	to.touching = to.slipping = 0;
	for (size_t m = 0; m < contactOf.size(); ++m) {
		const auto& meeting = system->meetings[m];
		if (contactOf[m] != number) continue;
		to.force.template head<Dim>() += sign * meeting.force;
		to.moment += sign * meeting.moment;
		to.touching += meeting.touching, to.slipping += meeting.slipping;
		if (to.isOfOne() && meeting.touching == 0) continue;
		records.push_back({ meeting.slave, meeting.master, meeting.pressure });
		for (const auto& shear : meeting.shear) {
			records.back().shears.push_back(Vector3r::Zero());
			records.back().shears.back().template head<Dim>() = shear;
		}
	}
	keepRecords(to, grid, records);
}

template class MeetingBodies<2>;
template class MeetingBodies<3>;

} // namespace yade
