// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/surface_lines.hpp"
#include <algorithm>
#include <cmath>

namespace gimpm {
namespace {

/// Where a segment crosses lines of the grid, as parts of its length, rising.
std::vector<double> crossings(const Vec<2>& a, const Vec<2>& b, const Grid<2>& grid)
{
	constexpr double    end = 1e-6; // of a cell, and of the length: nothing so short is cut off
	std::vector<double> parts;
	for (int axis = 0; axis < 2; ++axis) {
		const double from = (a[axis] - grid.origin[axis]) / grid.cellSize, to = (b[axis] - grid.origin[axis]) / grid.cellSize;
		for (double line = std::ceil(std::min(from, to) + end); line < std::max(from, to) - end; ++line)
			parts.push_back((line - from) / (to - from));
	}
	std::sort(parts.begin(), parts.end());
	const auto last = std::unique(parts.begin(), parts.end(), [](double s, double t) { return t - s < end; });
	parts.erase(last, parts.end());
	return parts;
}

} // namespace

template <int Dim> void cutAtLines([[maybe_unused]] Surface<Dim>& surface, [[maybe_unused]] const Grid<Dim>& grid)
{
	if constexpr (Dim == 2) {
		auto&                                     x = surface.vertices;
		std::vector<typename Surface<Dim>::Piece> parts;
		for (const auto& piece : surface.pieces) {
			int first = piece[0];
			for (const double s : crossings(x[piece[0]], x[piece[1]], grid)) {
				for (auto* all : { &surface.vertices, &surface.vertices0 })
					all->push_back(((1 - s) * (*all)[piece[0]] + s * (*all)[piece[1]]).eval());
				parts.push_back({ first, int(x.size()) - 1 });
				first = int(x.size()) - 1;
			}
			parts.push_back({ first, piece[1] });
		}
		surface.pieces = std::move(parts);
	}
}

template void cutAtLines(Surface<2>&, const Grid<2>&);
template void cutAtLines(Surface<3>&, const Grid<3>&);

} // namespace gimpm
