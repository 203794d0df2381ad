// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/engines/adaptation.hpp"
#include "core/base/sentence.hpp"
#include "engine/analysis/cells_by_size.hpp"
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

	// Around each position the cells that are to be halved last reach one of their sizes far.
	void addBoxes(Boxes& boxes, const Analysis& analysis, const Scene& scene, int halvings)
	{
		const Real size = analysis.grid->cellSize / (1 << (halvings - 1));
		for (const Listed& listed : analysis.conditions())
			for (const Vector3r& place : listed.condition->edges(analysis, scene, size)) {
				const auto box = shared_ptr<MpmRefinement>(new MpmRefinement);
				box->min = place - Vector3r::Constant(size), box->max = place + Vector3r::Constant(size);
				box->halvings = halvings;
				boxes.push_back(box);
			}
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
			addBoxes(tried, analysis, scene, halvings);
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
