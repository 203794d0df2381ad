// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/aggregates.hpp"
#include "core/terms/overlap.hpp"
#include <algorithm>
#include <cmath>

namespace gimpm {
namespace {

/// Volume of a leaf [m3], in 2D per metre; around an axis of symmetry all around it.
template <int Dim> double volumeOf(Key leaf, const Grid<Dim>& grid)
{
	const double h = grid.size(Grid<Dim>::level(leaf)), volume = std::pow(h, Dim);
	if (!grid.axisymmetric) return volume;
	return volume * 2 * M_PI * (grid.cellSize * (Grid<Dim>::index(leaf)[0] - grid.axisNode()) + h / 2);
}

/// Filled part of each populated leaf, by number. Domains of deformed points leave gaps and overlap.
template <int Dim> std::vector<double> filling(const CloudBasis<Dim>& basis, const PointStiffness& stiffnessOf, const Grid<Dim>& grid)
{
	const auto&         leaves = basis.populatedLeaves();
	std::vector<double> filled(leaves.size(), 0);
	forOverlaps(std::vector<char>(leaves.size(), 1), basis, grid, [&](int cell, int p, auto within) {
		filled[basis.leaf(cell)] += within(stiffnessOf(p).volume);
	});
	for (std::size_t i = 0; i < leaves.size(); ++i)
		filled[i] /= volumeOf(leaves[i], grid);
	return filled;
}

} // namespace

template <int Dim>
std::vector<char> tiesOfIllFilled(
        const std::vector<GhostFace<Dim>>& faces, const CloudBasis<Dim>& basis, const PointStiffness& stiffnessOf, const Grid<Dim>& grid, double threshold)
{
	constexpr double                alike  = 1e-6;
	const auto                      filled = filling(basis, stiffnessOf, grid);
	std::vector<std::array<int, 2>> cells;
	std::vector<char>               isConstrained(filled.size()), ties(faces.size(), 0);
	for (const auto& face : faces)
		cells.push_back(cellsAt(face, basis, grid));
	for (std::size_t i = 0; i < filled.size(); ++i)
		isConstrained[i] = filled[i] >= threshold;
	const auto forReached = [&](auto&& f) { // f(face, cell that is not held, one beside it that is)
		for (std::size_t i = 0; i < faces.size(); ++i)
			for (const int side : { 0, 1 })
				if (!isConstrained[cells[i][side]] && isConstrained[cells[i][1 - side]]) f(i, cells[i][side], cells[i][1 - side]);
	};
	for (bool goesOn = true; goesOn;) {
		std::vector<double> best(filled.size(), 0);
		forReached([&](std::size_t, int cell, int beside) { best[cell] = std::max(best[cell], std::min(1., filled[beside])); });
		forReached([&](std::size_t i, int cell, int beside) {
			if (std::min(1., filled[beside]) >= best[cell] * (1 - alike)) ties[i] = 1;
		});
		goesOn = false;
		for (std::size_t i = 0; i < filled.size(); ++i)
			if (best[i] > 0) isConstrained[i] = 1, goesOn = true;
	}
	for (std::size_t i = 0; i < faces.size(); ++i)
		ties[i] = ties[i] || !isConstrained[cells[i][0]] || !isConstrained[cells[i][1]];
	return ties;
}

template <int Dim> void lessenElsewhere(std::vector<GhostFace<Dim>>& faces, const std::vector<char>& ties, double part)
{
	for (std::size_t i = 0; i < faces.size(); ++i)
		if (!ties[i]) faces[i].stiffness *= part;
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template std::vector<char> tiesOfIllFilled(                                                                                                            \
	        const std::vector<GhostFace<Dim>>&, const CloudBasis<Dim>&, const PointStiffness&, const Grid<Dim>&, double);                                  \
	template void lessenElsewhere(std::vector<GhostFace<Dim>>&, const std::vector<char>&, double);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
