// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/mixed_cells.hpp"
#include <algorithm>

namespace gimpm {

// All points of a patch populate all its cells.
template <int Dim> std::vector<char> mixedCells(const CloudBasis<Dim>& basis, const std::vector<int>& material)
{
	std::vector<char> mixed(basis.populatedLeaves().size(), 0);
	if (std::adjacent_find(material.begin(), material.end(), std::not_equal_to<int>()) == material.end()) return mixed;
	std::vector<int> found(mixed.size(), -1);
	for (const auto& patch : basis.patches) {
		const auto points       = basis.order.begin() + patch.first;
		const int  first        = material[*points];
		const bool isMixedPatch = std::any_of(points, points + patch.count, [&](int p) { return material[p] != first; });
		for (const int cell : patch.reached) {
			if (cell < 0) continue;
			const int leaf = basis.leaf(cell);
			if (found[leaf] < 0) found[leaf] = first;
			mixed[leaf] |= isMixedPatch || found[leaf] != first;
		}
	}
	return mixed;
}

template std::vector<char> mixedCells(const CloudBasis<2>&, const std::vector<int>&);
template std::vector<char> mixedCells(const CloudBasis<3>&, const std::vector<int>&);

} // namespace gimpm
