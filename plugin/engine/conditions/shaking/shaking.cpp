// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/shaking/shaking.hpp"
#include "engine/engines/MpmDynamicEngine.hpp"
#include "engine/grid/fit.hpp"

namespace yade {

namespace {
	template <int Dim> void requireInDimension(const MpmBaseMotion& motion, const string& name)
	{
		motion.requireAdmissible();
		if (Dim == 2 && motion.direction[2] != 0)
			throw std::invalid_argument(
			        name + ".motion.direction = " + textOf(motion.direction)
			        + ": there is no direction z on a grid with dim=2 (plane strain in x-y).");
	}
}

template <int Dim>
gimpm::HeldBox<Dim> boxOfEdge(const shared_ptr<MpmAbsorbingBoundary>& edge, size_t number, const MpmGrid& grid, const gimpm::Grid<Dim>& lattice)
{
	if (!edge) throw std::invalid_argument("absorbing[" + std::to_string(number) + "] = None is not admitted: expected an MpmAbsorbingBoundary.");
	edge->requireAdmissible();
	return boxOfNodes<Dim>("MpmAbsorbingBoundary", edge->min, edge->max, grid, lattice);
}

template <int Dim> Shaking<Dim>::Shaking(const MpmDynamicEngine& engine, Job<Dim>& job, gimpm::Motion<Dim>& motion) : boxes(job.model.boundary.boxes())
{
	for (size_t i = 0; i < engine.absorbing.size(); ++i)
		join(engine.absorbing[i], i, engine, job.model);
	for (size_t b = 0; b < engine.boundaries.size(); ++b)
		if (engine.boundaries[b]->motion) bases[int(b)] = engine.boundaries[b]->motion;
	requireFittingBases(job.model);
	const auto [alpha, beta] = engine.rayleigh;
	const bool isDamped      = alpha != 0 || beta != 0;
	if (edges.empty() && !isDamped) return;
	const auto  materials = std::make_shared<const std::vector<gimpm::Material>>(job.model.materials);
	const auto* masses    = &motion.mass; // which have those of the copies, too, where points are divided
	if (isDamped) {
		*rayleigh = { alpha, beta };
		motion.damping.push_back([known = rayleigh, materials, masses, fBar = job.model.fBar](const gimpm::Beginning<Dim>& step) {
			return std::make_unique<gimpm::RayleighDamping<Dim>>(*known, *materials, fBar, *masses, step);
		});
	}
	for (const auto& [from, edge] : edges)
		motion.damping.push_back([known = edge, materials, masses](const gimpm::Beginning<Dim>& step) {
			return std::make_unique<gimpm::Absorption<Dim>>(*known, *materials, *masses, step);
		});
}

template <int Dim>
void Shaking<Dim>::join(const shared_ptr<MpmAbsorbingBoundary>& boundary, size_t number, const MpmDynamicEngine& engine, const gimpm::Model<Dim>& model)
{
	const string name = "absorbing[" + std::to_string(number) + "]";
	const auto   edge = std::make_shared<Edge>();
	edge->name        = name;
	edge->box         = boxOfEdge(boundary, number, *engine.grid, model.grid);
	edge->hasBegun    = boundary->hasBegun;
	if (boundary->motion) requireInDimension<Dim>(*boundary->motion, name);
	if (boundary->nodes.size() != boundary->borne.size()) throw std::invalid_argument(name + " has lost what it bears: give a new MpmAbsorbingBoundary.");
	for (size_t n = 0; n < boundary->nodes.size(); ++n)
		edge->borne[gimpm::Grid<Dim>::key(boundary->nodes[n].template head<Dim>().template cast<int>())] = boundary->borne[n].template head<Dim>();
	edges.emplace_back(boundary, edge);
}

// A node goes one way only.
template <int Dim> void Shaking<Dim>::requireFittingBases(const gimpm::Model<Dim>& model) const
{
	for (const auto& [b, motion] : bases) {
		const string name = "boundaries[" + std::to_string(b) + "]";
		requireInDimension<Dim>(*motion, name);
		for (int axis = 0; axis < Dim; ++axis) {
			if (motion->direction[axis] == 0) continue;
			if (!boxes[b].fixed[axis])
				throw std::invalid_argument(
				        name + ".motion.direction = " + textOf(motion->direction) + " goes along " + "xyz"[axis]
				        + ", which its fix leaves free.");
			if (model.grid.axisymmetric && axis == 0)
				throw std::invalid_argument(name + ".motion goes along x, the distance from the axis of MpmGrid.axisymmetric.");
			for (int other = 0; other < int(boxes.size()); ++other)
				if (const auto found = bases.find(other);
				    other != b && boxes[other].fixed[axis] && boxes[b].meets(boxes[other]) && (found == bases.end() || found->second != motion))
					throw std::invalid_argument(
					        name + " and boundaries[" + std::to_string(other) + "] hold the same nodes along " + "xyz"[axis]
					        + ", of which only one moves by that MpmBaseMotion: give both the same, or let sides be periodic (MpmGrid.period).");
		}
	}
}

template <int Dim> void Shaking<Dim>::begin(Attempt<Dim>& next, Real from, gimpm::Motion<Dim>& motion) const
{
	const Real duration = next.time - from, looked = from + duration / 2;
	const Real before = motion.scheme.atMiddle ? looked : from;
	const Real centre = motion.scheme.isExplicit ? next.time : looked; // of the steps that accelerations belong to
	for (const auto& [boundary, edge] : edges)
		if (boundary->motion) {
			edge->incomingBefore = boundary->motion->velocityAt(before).template head<Dim>();
			edge->incoming       = boundary->motion->velocityAt(motion.scheme.atMiddle ? looked : next.time).template head<Dim>();
		}
	motion.bases.clear();
	for (const auto& [b, history] : bases) {
		const Vector3r v0 = history->velocityAt(from), growth = history->velocityAt(centre + duration / 2) - history->velocityAt(centre - duration / 2);
		next.load.boxMotion[b] = history->displacementBetween(from, next.time).template head<Dim>();
		motion.bases.push_back({ boxes[b], v0.template head<Dim>(), (growth / duration).template head<Dim>() });
	}
}

template <int Dim> void Shaking<Dim>::scatter(const gimpm::StepReport& report) const
{
	for (size_t e = 0; e < edges.size(); ++e) {
		const auto& [boundary, edge] = edges[e];
		boundary->hasBegun           = true;
		boundary->nodes.clear();
		boundary->borne.clear();
		for (const auto& [key, force] : edge->borne) {
			Vector3r node = Vector3r::Zero(), inSpace = node;
			node.head<Dim>()    = gimpm::Grid<Dim>::index(key).template cast<Real>();
			inSpace.head<Dim>() = force;
			boundary->nodes.push_back(node);
			boundary->borne.push_back(inSpace);
		}
		boundary->reaction                      = Vector3r::Zero();
		boundary->reaction.template head<Dim>() = edge->force + report.openReactions[e].template head<Dim>(); // open boxes are in the order of edges
	}
}

template <int Dim> Real Shaking<Dim>::workOfEdges() const
{
	Real sum = 0;
	for (const auto& [boundary, edge] : edges)
		sum += edge->work;
	return sum;
}

template gimpm::HeldBox<2> boxOfEdge(const shared_ptr<MpmAbsorbingBoundary>&, size_t, const MpmGrid&, const gimpm::Grid<2>&);
template gimpm::HeldBox<3> boxOfEdge(const shared_ptr<MpmAbsorbingBoundary>&, size_t, const MpmGrid&, const gimpm::Grid<3>&);
template class Shaking<2>;
template class Shaking<3>;

} // namespace yade
