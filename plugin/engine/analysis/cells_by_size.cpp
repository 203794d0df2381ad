// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/analysis/cells_by_size.hpp"
#include "engine/analysis/exchange.hpp"
#include <set>

namespace yade {

namespace {
	template <int Dim> std::map<Real, int> countCells(const MpmGrid& grid, const vector<MaterialPoint>& points)
	{
		const auto lattice = grid.lattice<Dim>();
		const auto cells   = cellsOf(centresOnGrid(points, lattice), lattice);
		if (!lattice.refinement && !cells.empty()) return { { lattice.cellSize, int(cells.size()) } };
		std::set<gimpm::Key> leaves;
		for (const gimpm::Key cell : cells)
			leaves.insert(lattice.refinement->leafOf(cell));
		std::map<Real, int> counts;
		for (const gimpm::Key leaf : leaves)
			++counts[lattice.size(gimpm::Grid<Dim>::level(leaf))];
		return counts;
	}
}

std::map<Real, int> cellsBySize(const MpmGrid& grid, const vector<MaterialPoint>& points)
{
	return grid.dim == 2 ? countCells<2>(grid, points) : countCells<3>(grid, points);
}

} // namespace yade
