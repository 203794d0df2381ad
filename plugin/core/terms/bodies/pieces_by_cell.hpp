// SPDX-License-Identifier: GPL-2.0-or-later
// Pieces of a surface that may be near a contact point.
#pragma once
#include "core/grid/by_cell.hpp"
#include "core/grid/parts_of_body.hpp"
#include "core/terms/contact/facets.hpp"

namespace gimpm {

/// Pieces by the cells within reach of them.
template <int Dim> class PiecesByCell {
public:
	PiecesByCell(const Facets<Dim>& facets, const Grid<Dim>& grid, double reach) : byCell_(grid.origin, grid.cellSize)
	{
		for (std::size_t i = 0; i < facets.pieces.size(); ++i) {
			if (!facets.isThere(facets.pieces[i])) continue;
			Vec<Dim> low = facets.start[facets.pieces[i][0]], high = low;
			for (const int v : facets.pieces[i])
				low = low.cwiseMin(facets.start[v]), high = high.cwiseMax(facets.start[v]);
			const Vec<Dim> around = Vec<Dim>::Constant(reach);
			forIndicesUpTo<Dim>(
			        byCell_.cell(low - around), byCell_.cell(high + around), [&](const Index<Dim>& cell) { byCell_.add(cell, int(i)); });
		}
	}
	const std::vector<int>& near(const Vec<Dim>& x) const { return byCell_.in(byCell_.cell(x)); }

private:
	ByCell<Dim> byCell_;
};

} // namespace gimpm
