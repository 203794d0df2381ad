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

	// Centres of cells of the largest size.
	template <int Dim> vector<Vector3r> varyingCells(const MpmGrid& grid, const vector<MaterialPoint>& points)
	{
		const gimpm::Grid<Dim>             large { grid.cellSize, grid.origin.head<Dim>() };
		vector<gimpm::DeformedVolume<Dim>> deformed;
		for (const auto& [id, shape, state, material] : points)
			if (isOnGrid(state->pos, large)) deformed.push_back({ state->pos.template head<Dim>(), state->volume, state->defGrad });
		vector<Vector3r> centres;
		for (const auto& cell : gimpm::varyingCells<Dim>(deformed, large)) {
			centres.push_back(Vector3r::Zero());
			centres.back().template head<Dim>() = large.nodePosition(cell) + gimpm::Vec<Dim>::Constant(grid.cellSize / 2);
		}
		return centres;
	}

	// Cells with half of one around them: what deforms there has not left when the step ends.
	void addVarying(Boxes& boxes, const vector<Vector3r>& centres, const MpmGrid& grid, int halvings)
	{
		for (const Vector3r& centre : centres)
			addBox(boxes, centre, grid.cellSize, halvings);
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
		const bool           byEdges    = adaptation.where == "contact";
		vector<Vector3r>     varying;
		if (!byEdges) varying = grid.dim == 2 ? varyingCells<2>(grid, points) : varyingCells<3>(grid, points);
		for (; halvings > 0; --halvings) {
			Boxes tried = boxes;
			if (byEdges) addEdges(tried, analysis, scene, halvings);
			else
				addVarying(tried, varying, grid, halvings);
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
