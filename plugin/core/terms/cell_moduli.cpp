// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/cell_moduli.hpp"

namespace gimpm {

template <int Dim>
std::vector<double> cellModuli(const std::vector<char>& isAskedFor, const CloudBasis<Dim>& basis, const PointStiffness& stiffnessOf, const Grid<Dim>& grid)
{
	std::vector<double> volume(basis.cells.size(), 0), modulus(basis.cells.size(), 0);
	for (const auto& patch : basis.patches)
		for (int c = 0; c < windowCells<Dim>; ++c) {
			const int cell = patch.reached[c];
			if (cell < 0 || !isAskedFor[cell]) continue;
			for (int i = patch.first; i < patch.first + patch.count; ++i) {
				auto [overlap, young] = stiffnessOf(basis.order[i]);
				for (int a = 0; a < Dim; ++a)
					if (patch.span >> a & 1) overlap *= basis.axes[i][a].share(c >> a & 1, grid.cellSize);
				volume[cell] += overlap;
				modulus[cell] += overlap * young;
			}
		}
	for (std::size_t cell = 0; cell < modulus.size(); ++cell)
		if (isAskedFor[cell]) modulus[cell] /= volume[cell];
	return modulus;
}

template std::vector<double> cellModuli(const std::vector<char>&, const CloudBasis<2>&, const PointStiffness&, const Grid<2>&);
template std::vector<double> cellModuli(const std::vector<char>&, const CloudBasis<3>&, const PointStiffness&, const Grid<3>&);

} // namespace gimpm
