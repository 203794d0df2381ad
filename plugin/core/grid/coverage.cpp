// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/coverage.hpp"
#include "core/grid/cells_around.hpp"
#include "core/grid/grid.hpp"
#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace gimpm {
namespace {

struct Cell {
	double covered   = 0;
	bool   hasCentre = false;
};

template <int Dim> using Cells = std::unordered_map<Key, Cell>;

template <int Dim> void cover(Cells<Dim>& cells, const Vec<Dim>& x, const Vec<Dim>& half)
{
	const Vec<Dim>   low = x - half, high = x + half;
	const Index<Dim> first = low.array().floor().template cast<int>();
	for (int corner = 0; corner < 1 << Dim; ++corner) {
		Index<Dim> cell = first;
		double     part = 1;
		for (int a = 0; a < Dim; ++a) {
			cell[a] += corner >> a & 1;
			part *= std::max(0., std::min(high[a], cell[a] + 1.) - std::max(low[a], double(cell[a])));
		}
		if (part > 0) cells[Grid<Dim>::key(cell)].covered += part;
	}
	cells[Grid<Dim>::key(Index<Dim>(x.array().floor().template cast<int>()))].hasCentre = true;
}

template <int Dim> bool isWithin(const Cells<Dim>& cells, const Index<Dim>& cell)
{
	for (int n = 0; n < cellsAround<Dim>; ++n) {
		const auto found = cells.find(Grid<Dim>::key(cell + offsetAround<Dim>(n)));
		if (found == cells.end() || !found->second.hasCentre) return false;
	}
	return true;
}

} // namespace

template <int Dim> Coverage coverage(const std::vector<Vec<Dim>>& centres, const std::vector<Vec<Dim>>& halfLengths)
{
	Cells<Dim> cells;
	for (std::size_t p = 0; p < centres.size(); ++p)
		cover<Dim>(cells, centres[p], halfLengths[p]);
	Coverage result;
	for (const auto& [key, cell] : cells) {
		if (!isWithin<Dim>(cells, Grid<Dim>::index(key))) continue;
		const double off = std::abs(cell.covered - 1);
		result.mean += off, result.largest = std::max(result.largest, off), ++result.cells;
	}
	if (result.cells > 0) result.mean /= result.cells;
	return result;
}

template Coverage coverage(const std::vector<Vec<2>>&, const std::vector<Vec<2>>&);
template Coverage coverage(const std::vector<Vec<3>>&, const std::vector<Vec<3>>&);

} // namespace gimpm
