// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/cell_moduli.hpp"
#include "core/terms/overlap.hpp"

namespace gimpm {

template <int Dim>
std::vector<double> cellModuli(const std::vector<char>& isAskedFor, const CloudBasis<Dim>& basis, const PointStiffness& stiffnessOf, const Grid<Dim>& grid)
{
	const std::size_t   leaves = basis.populatedLeaves().size();
	std::vector<double> volume(leaves, 0), modulus(leaves, 0);
	forOverlaps(isAskedFor, basis, grid, [&](int cell, int p, auto within) {
		const auto [whole, young] = stiffnessOf(p);
		const double overlap      = within(whole);
		volume[basis.leaf(cell)] += overlap;
		modulus[basis.leaf(cell)] += overlap * young;
	});
	for (std::size_t leaf = 0; leaf < leaves; ++leaf)
		if (isAskedFor[leaf]) modulus[leaf] /= volume[leaf];
	return modulus;
}

template std::vector<double> cellModuli(const std::vector<char>&, const CloudBasis<2>&, const PointStiffness&, const Grid<2>&);
template std::vector<double> cellModuli(const std::vector<char>&, const CloudBasis<3>&, const PointStiffness&, const Grid<3>&);

} // namespace gimpm
