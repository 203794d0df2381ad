// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/analysis/cells_by_size.hpp"
#include "engine/analysis/exchange.hpp"
#include <set>

namespace yade {

namespace {
	template <int Dim> std::map<Real, int> countCells(const MpmGrid& grid, const vector<MaterialPoint>& points)
	{
		const auto           lattice = grid.lattice<Dim>();
		std::set<gimpm::Key> leaves;
		for (const gimpm::Key cell : cellsOf(centresOnGrid(points, lattice), lattice))
			leaves.insert(lattice.refinement ? lattice.refinement->leafOf(cell) : cell);
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
