// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/shaking/edges.hpp"
#include "engine/grid/fit.hpp"

namespace yade {

namespace {
	MpmAbsorbingBoundary& boundaryOf(const Listed& listed) { return static_cast<MpmAbsorbingBoundary&>(*listed.condition); }
}

template <int Dim> gimpm::ConstrainedBox<Dim> Edges<Dim>::boxOf(const MpmAbsorbingBoundary& boundary, const gimpm::Grid<Dim>& lattice) const
{
	return boxOfNodes<Dim>("MpmAbsorbingBoundary", boundary.min, boundary.max, *analysis.grid, lattice);
}

template <int Dim> void Edges<Dim>::hold(gimpm::Model<Dim>& model)
{
	vector<gimpm::ConstrainedBox<Dim>> open;
	for (const Listed& listed : group)
		open.push_back(boxOf(boundaryOf(listed), model.grid));
	model.boundary = gimpm::Boundary<Dim>(model.boundary.boxes(), open);
}

template <int Dim>
auto Edges<Dim>::edgeOf(const MpmAbsorbingBoundary& boundary, const string& name, const gimpm::Grid<Dim>& lattice) const -> std::shared_ptr<Edge>
{
	const auto edge = std::make_shared<Edge>();
	edge->name      = name;
	edge->box       = boxOf(boundary, lattice);
	edge->hasBegun  = boundary.hasBegun;
	if (boundary.motion) boundary.motion->requireInDimension(Dim, name);
	if (boundary.nodes.size() != boundary.borne.size()) throw std::invalid_argument(name + " has lost what it bears: give a new MpmAbsorbingBoundary.");
	for (size_t n = 0; n < boundary.nodes.size(); ++n)
		edge->borne[gimpm::Grid<Dim>::key(boundary.nodes[n].template head<Dim>().template cast<int>())] = boundary.borne[n].template head<Dim>();
	return edge;
}

template <int Dim> void Edges<Dim>::joinMotion(gimpm::Motion<Dim>& joined, const gimpm::Model<Dim>& model, Real)
{
	motion = &joined;
	for (const Listed& listed : group)
		edges.emplace_back(boost::static_pointer_cast<MpmAbsorbingBoundary>(listed.condition), edgeOf(boundaryOf(listed), listed.name(), model.grid));
	const auto  materials = std::make_shared<const std::vector<gimpm::Material>>(model.materials);
	const auto* masses    = &joined.mass; // masses that include those of the copies where points are divided
	for (const auto& [from, edge] : edges)
		joined.damping.push_back([known = edge, materials, masses](const gimpm::StepContext<Dim>& step) {
			return std::make_unique<gimpm::Absorption<Dim>>(*known, *materials, *masses, step);
		});
}

template <int Dim> void Edges<Dim>::advance(const StepTime& step, gimpm::Model<Dim>&, gimpm::Load<Dim>&)
{
	if (!motion) return;
	for (const auto& [boundary, edge] : edges) {
		if (!boundary->motion) continue;
		edge->incomingBefore = boundary->motion->velocityAt(motion->scheme.atMiddle ? step.looked : step.from).template head<Dim>();
		edge->incoming       = boundary->motion->velocityAt(step.looked).template head<Dim>();
	}
}

template <int Dim> void Edges<Dim>::reach(const StepOutcome<Dim>& step)
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
		boundary->reaction = Vector3r::Zero();
		boundary->reaction.template head<Dim>()
		        = edge->force + step.report.openReactions[e].template head<Dim>(); // open boxes are in the order of edges
	}
}

template <int Dim> Work Edges<Dim>::work(const StepOutcome<Dim>&) const
{
	Work sum;
	for (const auto& [boundary, edge] : edges)
		sum.ofBoundaries += edge->work;
	return sum;
}

template class Edges<2>;
template class Edges<3>;

} // namespace yade
