// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/boundary/walls.hpp"
#include "engine/conditions/surface/surfaces.hpp"

namespace yade {

namespace {
	template <int Dim> void requireFitting(const MpmBoundary& boundary, const string& name)
	{
		requireDimension<Dim>(*boundary.surface, name);
		if (Dim == 2 && (boundary.fixes(2) || boundary.velocity[2] != 0))
			throw std::invalid_argument(
			        name + " has fix = '" + boundary.fix + "' and velocity = " + textOf(boundary.velocity)
			        + ": there is no direction z on a grid with dim=2 (plane strain in x-y).");
	}

	// Nodes a period apart are the same: what is longer would act twice.
	template <int Dim> void requireWithinPeriod(const MpmBoundary& boundary, const string& name, const gimpm::Grid<Dim>& grid)
	{
		const auto [lower, upper] = *boundary.extent();
		for (int axis = 0; axis < Dim; ++axis) {
			const Real period = grid.period[axis] * grid.cellSize, length = upper[axis] - lower[axis];
			if (period == 0 || length <= period * (1 + 1e-9)) continue;
			std::ostringstream text;
			text << name << ".surface is " << length << " m long along "
			     << "xyz"[axis] << ", but the grid repeats itself after " << period << " m (MpmGrid.period): expected one period at most.";
			throw std::invalid_argument(text.str());
		}
	}
}

template <int Dim> std::shared_ptr<gimpm::Wall<Dim>> wallOf(const MpmBoundary& boundary, const string& name, const gimpm::Model<Dim>& model, Real smallestCell)
{
	const auto& grid = model.grid;
	if (model.ghost.factor == 0)
		throw std::invalid_argument(
		        name
		        + ".surface may constrain nodes that hardly any material is near: it needs ghost stabilisation, such as ghost=MpmGhost(), instead of "
		          "ghost.factor=0.");
	requireFitting<Dim>(boundary, name);
	requireWithinPeriod<Dim>(boundary, name, grid);
	const auto wall = std::make_shared<gimpm::Wall<Dim>>(coreSurface<Dim>(*boundary.surface), smallestCell);
	wall->penalty   = boundary.penalty;
	for (int axis = 0; axis < Dim; ++axis)
		wall->fixed[axis] = boundary.fixes(axis);
	// It has not borne anything yet.
	if (boundary.surface->initialVertices.empty() || boundary.tractions.empty()) return wall;
	if (boundary.tractions.size() != wall->tractions.size())
		throw std::invalid_argument(
		        name + ".surface has " + std::to_string(wall->tractions.size()) + " pieces of a size for cells of " + std::to_string(smallestCell)
		        + " m, but what it bears is known of " + std::to_string(boundary.tractions.size())
		        + ": after a change of the grid or of the pieces give it a new MpmSurface, which bears nothing at first.");
	wall->tractions = inDimension<Dim>(boundary.tractions);
	return wall;
}

template std::shared_ptr<gimpm::Wall<2>> wallOf(const MpmBoundary&, const string&, const gimpm::Model<2>&, Real);
template std::shared_ptr<gimpm::Wall<3>> wallOf(const MpmBoundary&, const string&, const gimpm::Model<3>&, Real);

} // namespace yade
