// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/boundary/boundaries.hpp"
#include "engine/conditions/bodies/layers.hpp"
#include "engine/conditions/boundary/boxes.hpp"
#include "engine/conditions/boundary/walls.hpp"
#include "engine/conditions/surface/surfaces.hpp"

namespace yade {

template <int Dim> Boundaries<Dim>::Boundaries(const MpmCondition::Group& group, const Analysis& analysis) : analysis(analysis)
{
	for (const Listed& listed : group)
		boundaries.push_back(boost::static_pointer_cast<MpmBoundary>(listed.condition));
}

// Before the box of the axis of symmetry, which is there.
template <int Dim> void Boundaries<Dim>::hold(gimpm::Model<Dim>& model)
{
	boxes = heldBoxes<Dim>(boundaries, *analysis.grid, model.grid);
	for (size_t b = 0; b < boundaries.size(); ++b) {
		boxes[b].layer      = layerOf(analysis, boundaries[b]->body);
		boxes[b].hasHistory = boundaries[b]->motion != nullptr;
	}
	refuseConflicts(boxes, boundaries);
	const auto& axis = model.boundary.boxes();
	boxes.insert(boxes.end(), axis.begin(), axis.end());
	model.boundary = gimpm::Boundary<Dim>(boxes);
	for (size_t b = 0; b < boundaries.size(); ++b)
		if (boundaries[b]->surface) {
			walls[int(b)]        = wallOf<Dim>(*boundaries[b], "boundaries[" + std::to_string(b) + "]", model, analysis.grid->smallestCell());
			walls[int(b)]->layer = boxes[b].layer;
		}
	model.walls = walls;
}

template <int Dim> void Boundaries<Dim>::joinMotion(gimpm::Motion<Dim>& joined, const gimpm::Model<Dim>& model, Real)
{
	motion = &joined;
	for (size_t b = 0; b < boundaries.size(); ++b)
		if (boundaries[b]->motion) bases[int(b)] = boundaries[b]->motion;
	requireFittingBases(model);
}

// A node goes one way only.
template <int Dim> void Boundaries<Dim>::requireFittingBases(const gimpm::Model<Dim>& model) const
{
	for (const auto& [b, history] : bases) {
		const string name = "boundaries[" + std::to_string(b) + "]";
		history->requireInDimension(Dim, name);
		for (int axis = 0; axis < Dim; ++axis) {
			if (history->direction[axis] == 0) continue;
			if (!boxes[b].fixed[axis])
				throw std::invalid_argument(
				        name + ".motion.direction = " + textOf(history->direction) + " goes along " + "xyz"[axis]
				        + ", which its fix leaves free.");
			if (model.grid.axisymmetric && axis == 0)
				throw std::invalid_argument(name + ".motion goes along x, the distance from the axis of MpmGrid.axisymmetric.");
			for (int other = 0; other < int(boxes.size()); ++other)
				if (const auto found = bases.find(other); other != b && boxes[other].fixed[axis] && boxes[b].meets(boxes[other])
				    && (found == bases.end() || found->second != history))
					throw std::invalid_argument(
					        name + " and boundaries[" + std::to_string(other) + "] constrain the same nodes along " + "xyz"[axis]
					        + ", of which only one moves by that MpmBaseMotion: give both the same, or let sides be periodic (MpmGrid.period).");
		}
	}
}

template <int Dim> void Boundaries<Dim>::advance(const StepTime& step, gimpm::Model<Dim>&, gimpm::Load<Dim>& load)
{
	for (size_t b = 0; b < boundaries.size(); ++b)
		if (!boundaries[b]->curve.empty()) load.ofBoxes[int(b)] = analysis.curveOfLoad(boundaries[b]->curve).between(step.from, step.to);
	for (auto& [b, wall] : walls) {
		wall->motion = (step.to - step.from) * boundaries[b]->velocity.template head<Dim>();
		if (!wall->motion.isZero(0)) load.motion = step.to - step.from;
	}
	if (motion) moveBases(step, load);
}

template <int Dim> void Boundaries<Dim>::moveBases(const StepTime& step, gimpm::Load<Dim>& load) const
{
	const Real duration = step.to - step.from;
	// Centre and length of the steps that accelerations belong to.
	const Real centre = motion->scheme.isExplicit ? step.to : step.from + duration / 2;
	motion->bases.clear();
	for (const auto& [b, history] : bases) {
		const Vector3r v0     = history->velocityAt(step.from),
		               growth = history->velocityAt(centre + duration / 2) - history->velocityAt(centre - duration / 2);
		load.boxMotion[b]     = history->displacementBetween(step.from, step.to).template head<Dim>();
		motion->bases.push_back({ boxes[b], v0.template head<Dim>(), (growth / duration).template head<Dim>() });
	}
}

template <int Dim> bool Boundaries<Dim>::areBeside(const gimpm::Vec<Dim>& point, const gimpm::Vec<Dim>& part) const
{
	return std::none_of(walls.begin(), walls.end(), [&](const auto& numbered) { return numbered.second->surface.isBetween(point, part); });
}

template <int Dim> Work Boundaries<Dim>::work(const StepOutcome<Dim>& step) const
{
	const auto &now = step.reactions, &before = step.reactionsBefore;
	const bool  hasBefore = before.size() == now.size() && !motion->scheme.atMiddle;
	Work        work;
	for (size_t b = 0; b < now.size(); ++b) {
		const MpmBoundary& boundary = *boundaries[b];
		const Vector3r     reaction = hasBefore ? Vector3r((now[b] + before[b]) / 2) : now[b];
		if (boundary.motion) {
			work.ofBoundaries += boundary.motion->displacementBetween(step.from, step.time).dot(reaction);
			continue;
		}
		const Real     growth = analysis.curveOfLoad(boundary.curve).between(step.from, step.time).growth;
		const Vector3r moved  = boundary.surface ? Vector3r((step.time - step.from) * boundary.velocity) : Vector3r(growth * boundary.displacement);
		work.ofBoundaries += moved.dot(reaction);
	}
	return work;
}

template <int Dim> void Boundaries<Dim>::reach(const StepOutcome<Dim>&)
{
	for (const auto& [b, wall] : walls) {
		scatter<Dim>(wall->surface, *boundaries[b]->surface);
		boundaries[b]->tractions = inSpace<Dim>(wall->tractions, 0);
	}
}

template class Boundaries<2>;
template class Boundaries<3>;

} // namespace yade
