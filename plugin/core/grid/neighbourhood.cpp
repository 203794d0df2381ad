// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/neighbourhood.hpp"
#include <algorithm>
#include <unordered_map>

namespace gimpm {

template <int Dim> Key lowestCell(const Vec<Dim>& position, const Vec<Dim>& halfSize, const Grid<Dim>& grid, Basis basis, int layer)
{
	Index<Dim> lowest;
	for (int a = 0; a < Dim; ++a) {
		const double x = position[a] - grid.origin[a];
		lowest[a]      = basis == Basis::gimp ? AxisCells::reached(x, halfSize[a], grid.cellSize).lowest : centreCell(x, grid.cellSize);
	}
	return Grid<Dim>::key(grid.first(lowest), 0, layer);
}

template <int Dim> std::vector<int> neededBy(const Division& division, Key lowest, const Grid<Dim>& grid, bool isWide)
{
	// Nodes along an axis.
	const int        below = isWide ? -1 : 0, above = isWide ? 3 : 2, wide = above - below + 1;
	std::vector<int> needed;
	for (int n = 0; n < (Dim == 2 ? wide * wide : wide * wide * wide); ++n) {
		Key node = lowest;
		for (int a = 0, rest = n; a < Dim; ++a, rest /= wide)
			node += Key(std::int64_t(below + rest % wide)) * Grid<Dim>::keyStep(a);
		if (const int constrainingBox = division.processOf(grid.first(node)); needed.empty() || needed.back() != constrainingBox)
			needed.push_back(constrainingBox);
	}
	std::sort(needed.begin(), needed.end());
	needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
	return needed;
}

template <int Dim>
std::vector<std::vector<int>> neededPoints(const PointCloud<Dim>& cloud, const Division& division, const Grid<Dim>& grid, Basis basis, bool isWide)
{
	std::vector<std::vector<int>>             points(division.processes->size());
	std::unordered_map<Key, std::vector<int>> known;
	for (int p = 0; p < division.ownOf(cloud.size()); ++p) {
		const Key lowest          = lowestCell<Dim>(cloud.position[p], cloud.halfSize[p], grid, basis, cloud.layerOf(p));
		const auto [found, isNew] = known.try_emplace(lowest);
		if (isNew) found->second = neededBy<Dim>(division, lowest, grid, isWide);
		for (const int process : found->second)
			if (process != division.processes->rank()) points[process].push_back(p);
	}
	return points;
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template Key                           lowestCell(const Vec<Dim>&, const Vec<Dim>&, const Grid<Dim>&, Basis, int);                                     \
	template std::vector<int>              neededBy<Dim>(const Division&, Key, const Grid<Dim>&, bool);                                                    \
	template std::vector<std::vector<int>> neededPoints(const PointCloud<Dim>&, const Division&, const Grid<Dim>&, Basis, bool);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
