// SPDX-License-Identifier: GPL-2.0-or-later
// Overlap of the domains of the points with the cells.
#pragma once
#include "core/grid/cloud_basis.hpp"

namespace gimpm {

/// Calls f(cell, point of the cloud, within) for the populated cells in the leaves that are asked for, by number;
/// within(volume of the point) is what of it is in the cell.
template <int Dim, class F> void forOverlaps(const std::vector<char>& isAskedFor, const CloudBasis<Dim>& basis, const Grid<Dim>& grid, F&& f)
{
	for (const auto& patch : basis.patches)
		for (int c = 0; c < windowCells<Dim>; ++c) {
			const int cell = patch.reached[c];
			if (cell < 0 || !isAskedFor[basis.leaf(cell)]) continue;
			for (int i = patch.first; i < patch.first + patch.count; ++i) {
				f(cell, basis.order[i], [&](double volume) {
					for (int a = 0; a < Dim; ++a)
						if (patch.span >> a & 1) volume *= basis.axes[i][a].share(c >> a & 1, grid.size(Grid<Dim>::level(patch.cell)));
					return volume;
				});
			}
		}
}

} // namespace gimpm
