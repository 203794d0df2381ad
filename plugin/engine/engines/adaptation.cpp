// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/engines/adaptation.hpp"
#include "core/base/sentence.hpp"
#include "core/grid/varying_cells.hpp"
#include "engine/analysis/cells_by_size.hpp"
#include "engine/analysis/exchange.hpp"
#include "yade_api/scene.hpp"
#include <numeric>

namespace yade {

namespace {
	using Boxes = vector<shared_ptr<MpmRefinement>>;

	// Displacement unknowns: a node for each cell, and few more.
	Real unknownsOf(const MpmGrid& grid, const vector<MaterialPoint>& points)
	{
		const auto cells = cellsBySize(grid, points);
		return std::accumulate(cells.begin(), cells.end(), Real(0), [&](Real sum, const auto& cell) { return sum + grid.dim * cell.second; });
	}

	void addBox(Boxes& boxes, const Vector3r& middle, Real half, int halvings)
	{
		const auto box = shared_ptr<MpmRefinement>(new MpmRefinement);
		box->min = middle - Vector3r::Constant(half), box->max = middle + Vector3r::Constant(half);
		box->halvings = halvings;
		boxes.push_back(box);
	}

	// Around each position the cells that are to be halved last reach one of their sizes far.
	void addEdges(Boxes& boxes, const Analysis& analysis, const Scene& scene, int halvings)
	{
		const Real size = analysis.grid->cellSize / (1 << (halvings - 1));
		for (const Listed& listed : analysis.conditions())
			for (const Vector3r& place : listed.condition->edges(analysis, scene, size))
				addBox(boxes, place, size, halvings);
	}

	// Cells of the largest size, and half of one around them: what deforms there has not left when the step ends.
	template <int Dim> void addVarying(Boxes& boxes, const MpmGrid& grid, const vector<MaterialPoint>& points, int halvings)
	{
		const gimpm::Grid<Dim>             large { grid.cellSize, grid.origin.head<Dim>() };
		vector<gimpm::DeformedVolume<Dim>> deformed;
		for (const auto& [id, shape, state, material] : points)
			if (isOnGrid(state->pos, large)) deformed.push_back({ state->pos.template head<Dim>(), state->volume, state->defGrad });
		for (const auto& cell : gimpm::varyingCells<Dim>(deformed, large)) {
			Vector3r middle             = Vector3r::Zero();
			middle.template head<Dim>() = large.nodePosition(cell) + gimpm::Vec<Dim>::Constant(grid.cellSize / 2);
			addBox(boxes, middle, grid.cellSize, halvings);
		}
	}

	void addBoxes(Boxes& boxes, const MpmAdaptation& by, const Analysis& analysis, const Scene& scene, const vector<MaterialPoint>& points, int halvings)
	{
		if (by.where == "contact") return addEdges(boxes, analysis, scene, halvings);
		analysis.grid->dim == 2 ? addVarying<2>(boxes, *analysis.grid, points, halvings) : addVarying<3>(boxes, *analysis.grid, points, halvings);
	}
}

string adapt(const Analysis& analysis, const Scene& scene, const vector<MaterialPoint>& points)
{
	MpmGrid& grid = *analysis.grid;
	Boxes    boxes;
	string   said;
	for (size_t a = 0; a < grid.adaptation.size(); ++a) {
		const MpmAdaptation& adaptation = *grid.adaptation[a];
		int                  halvings   = adaptation.halvings;
		Real                 unknowns   = 0;
		for (; halvings > 0; --halvings) {
			Boxes tried = boxes;
			addBoxes(tried, adaptation, analysis, scene, points, halvings);
			grid.adapted = std::move(tried);
			if (!std::isfinite(adaptation.maxUnknowns)) break;
			unknowns = unknownsOf(grid, points);
			if (unknowns <= adaptation.maxUnknowns) break;
		}
		if (halvings > 0) boxes = grid.adapted;
		if (halvings < adaptation.halvings)
			said = gimpm::sentence(
			        "MpmGrid.adaptation[", a, "].maxUnknowns = ", adaptation.maxUnknowns, " admits ", halvings, " of ", adaptation.halvings,
			        " halvings of cells. Larger cells elsewhere, or a larger maxUnknowns, admit more.");
	}
	grid.adapted = boxes;
	return said;
}

} // namespace yade
