// SPDX-License-Identifier: GPL-2.0-or-later
// Pieces of a surface that may be near a contact point.
#pragma once
#include "core/terms/contact/facets.hpp"
#include <unordered_map>

namespace gimpm {

/// Pieces by the cells within reach of them.
template <int Dim> class PiecesByCell {
public:
	PiecesByCell(const Facets<Dim>& facets, const Grid<Dim>& grid, double reach) : grid_(grid)
	{
		for (std::size_t i = 0; i < facets.pieces.size(); ++i) {
			if (!facets.isThere(facets.pieces[i])) continue;
			Vec<Dim> low = facets.start[facets.pieces[i][0]], high = low;
			for (const int v : facets.pieces[i])
				low = low.cwiseMin(facets.start[v]), high = high.cwiseMax(facets.start[v]);
			const Index<Dim> first = cell(low - Vec<Dim>::Constant(reach)), last = cell(high + Vec<Dim>::Constant(reach));
			Index<Dim>       c = first;
			for (int a = 0; a < Dim;) {
				pieces_[Grid<Dim>::key(c)].push_back(int(i));
				for (a = 0; a < Dim && ++c[a] > last[a]; ++a)
					c[a] = first[a];
			}
		}
	}
	const std::vector<int>& near(const Vec<Dim>& x) const
	{
		static const std::vector<int> none;
		const auto                    found = pieces_.find(Grid<Dim>::key(cell(x)));
		return found == pieces_.end() ? none : found->second;
	}

private:
	Index<Dim> cell(const Vec<Dim>& x) const { return ((x - grid_.origin) / grid_.cellSize).array().floor().template cast<int>(); }

	const Grid<Dim>&                          grid_;
	std::unordered_map<Key, std::vector<int>> pieces_;
};

} // namespace gimpm
