// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/grid/cells_by_size.hpp"
#include <unordered_set>

namespace yade {

namespace {
	template <int Dim> std::map<Real, int> countCells(const MpmGrid& grid, const vector<MaterialPoint>& points)
	{
		const auto                     lattice = grid.lattice<Dim>();
		std::unordered_set<gimpm::Key> leaves;
		for (const MaterialPoint& point : points) {
			const gimpm::Vec<Dim> x = (point.state->pos.head<Dim>() - lattice.origin) / lattice.cellSize;
			if (!(x.array().abs() < lattice.indexLimit).all()) continue;
			const gimpm::Key cell = gimpm::Grid<Dim>::key(x.array().floor().template cast<int>());
			leaves.insert(lattice.refinement ? lattice.refinement->leafOf(cell) : cell);
		}
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
