// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/filled_cells.hpp"
#include "core/grid/point_order.hpp"
#include <algorithm>

namespace gimpm {
namespace {

void makeSet(std::vector<Key>& keys)
{
	std::sort(keys.begin(), keys.end());
	keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

} // namespace

template <int Dim>
Boundary<Dim> amongSoil(const Boundary<Dim>& boundary, const PointCloud<Dim>& cloud, const Grid<Dim>& grid, Basis basis, const Division& division)
{
	Boundary<Dim> result = boundary;
	if (std::none_of(boundary.boxes().begin(), boundary.boxes().end(), [](const ConstrainedBox<Dim>& box) { return box.moves(); })) return result;
	std::vector<Key> cells;
	for (int p = 0; p < int(cloud.size()); ++p) {
		const int        level = levelOf(cloud, p, grid, basis), layer = cloud.layerOf(p);
		const Index<Dim> cell = containingCell<Dim>(cloud.position[p] - grid.origin, grid.size(level), boundary, level, layer);
		cells.push_back(Grid<Dim>::key(grid.first(cell * (1 << level)), level, layer));
	}
	makeSet(cells);
	cells = division.joined(boundary.besideMoving(cells));
	makeSet(cells);
	result.setFilled(std::move(cells));
	return result;
}

template Boundary<2> amongSoil(const Boundary<2>&, const PointCloud<2>&, const Grid<2>&, Basis, const Division&);
template Boundary<3> amongSoil(const Boundary<3>&, const PointCloud<3>&, const Grid<3>&, Basis, const Division&);

} // namespace gimpm
