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

	template <int Dim> vector<gimpm::DeformedVolume<Dim>> deformedVolumes(const gimpm::Grid<Dim>& grid, const vector<MaterialPoint>& points)
	{
		vector<gimpm::DeformedVolume<Dim>> all;
		for (const auto& [id, shape, state, material] : points)
			if (isOnGrid(state->pos, grid))
				all.push_back({ state->pos.template head<Dim>(), state->volume, state->defGrad.template topLeftCorner<Dim, Dim>() });
		return all;
	}

	// Centres of cells that vary too much for their size, for each size that is halved.
	struct Varying {
		vector<vector<Vector3r>> bySize;
		bool                     isServed = true; // by the cells of the last step, which are not many more
	};

	template <int Dim> Varying varyingCells(const MpmGrid& grid, const vector<MaterialPoint>& points, int halvings)
	{
		constexpr double mostError = 0.05; // of cells that are not halved, as a part of the deformation
		constexpr double fewest    = 0.75; // of the cells of the last step
		const auto       isOften   = [&](const auto& box) { return box->halvings > halvings; };
		Varying          all;
		all.isServed       = std::none_of(grid.adapted.begin(), grid.adapted.end(), isOften);
		const auto last    = grid.lattice<Dim>();
		const auto volumes = deformedVolumes<Dim>(last, points);
		for (int h = 0; h < halvings; ++h) {
			const gimpm::Grid<Dim> cells { grid.cellSize / (1 << h), grid.origin.head<Dim>() };
			const auto centre = [&](const auto& cell) { return (cells.nodePosition(cell) + gimpm::Vec<Dim>::Constant(cells.cellSize / 2)).eval(); };
			const auto isHalved = [&](const auto& cell) { return gimpm::largestHalf<Dim>(last, centre(cell)) < 0.3 * cells.cellSize; };
			const auto isOfSize = [&](const auto& box) { return box->halvings == h + 1; };
			const gimpm::CellErrors<Dim> errors(volumes, cells);
			vector<Vector3r>             centres;
			for (const auto& cell : errors.largest(mostError)) {
				centres.push_back(Vector3r::Zero());
				centres.back().template head<Dim>() = centre(cell);
			}
			const auto before = std::count_if(grid.adapted.begin(), grid.adapted.end(), isOfSize);
			all.isServed      = all.isServed && errors.without(isHalved) <= mostError && centres.size() >= fewest * before;
			all.bySize.push_back(std::move(centres));
		}
		return all;
	}
	Varying varyingCells(const MpmGrid& grid, const vector<MaterialPoint>& points, int halvings)
	{
		return grid.dim == 2 ? varyingCells<2>(grid, points, halvings) : varyingCells<3>(grid, points, halvings);
	}

	// Cells with half of one around them: what deforms there has not left when the step ends.
	void addVarying(Boxes& boxes, const vector<vector<Vector3r>>& bySize, const MpmGrid& grid, int halvings)
	{
		for (int h = 0; h < halvings; ++h)
			for (const Vector3r& centre : bySize[h])
				addBox(boxes, centre, grid.cellSize / (1 << h), h + 1);
	}

	// The cells that a function wants to be halved, and no others.
	void addWanted(Boxes& boxes, const vector<vector<Vector3r>>& bySize, const MpmGrid& grid, int halvings)
	{
		for (size_t h = 0; h < std::min(bySize.size(), size_t(halvings)); ++h)
			for (const Vector3r& centre : bySize[h])
				addBox(boxes, centre, grid.cellSize / (4 << h), int(h) + 1);
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
		const bool           byError    = adaptation.where == "error";
		const auto           varying    = byError ? varyingCells(grid, points, halvings) : Varying();
		if (byError && grid.adaptation.size() == 1 && varying.isServed) return "";
		for (; halvings > 0; --halvings) {
			Boxes tried = boxes;
			if (byError) addVarying(tried, varying.bySize, grid, halvings);
			else if (adaptation.where.size)
				addWanted(tried, adaptation.wanted, grid, halvings);
			else
				addEdges(tried, analysis, scene, halvings);
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
