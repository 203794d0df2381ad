// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/cell_moduli.hpp"
#include "core/terms/overlap.hpp"

namespace gimpm {

template <int Dim>
std::vector<double> cellModuli(const std::vector<char>& isAskedFor, const CloudBasis<Dim>& basis, const PointStiffness& stiffnessOf, const Grid<Dim>& grid)
{
	std::vector<double> volume(basis.cells.size(), 0), modulus(basis.cells.size(), 0);
	forOverlaps(isAskedFor, basis, grid, [&](int cell, int p, auto within) {
		const auto [whole, young] = stiffnessOf(p);
		const double overlap      = within(whole);
		volume[cell] += overlap;
		modulus[cell] += overlap * young;
	});
	for (std::size_t cell = 0; cell < modulus.size(); ++cell)
		if (isAskedFor[cell]) modulus[cell] /= volume[cell];
	return modulus;
}

template std::vector<double> cellModuli(const std::vector<char>&, const CloudBasis<2>&, const PointStiffness&, const Grid<2>&);
template std::vector<double> cellModuli(const std::vector<char>&, const CloudBasis<3>&, const PointStiffness&, const Grid<3>&);

} // namespace gimpm
