// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/coverage.hpp"
#include "core/grid/cells_around.hpp"
#include "core/grid/grid.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace gimpm {
namespace {

struct Cell {
	double covered   = 0;
	bool   hasCentre = false;
};

template <int Dim> using Cells = std::unordered_map<Key, Cell>;

/// Adds domains to the cells. Points that follow each other lie in the same ones: these are at hand.
template <int Dim> class Covering {
public:
	explicit Covering(Cells<Dim>& cells) : cells_(cells) { }

	void add(const Vec<Dim>& x, const Vec<Dim>& half)
	{
		const Vec<Dim>   low = x - half, high = x + half;
		const Index<Dim> first = low.array().floor().template cast<int>();
		if (!cell_[0] || first != first_) find(first);
		for (int corner = 0; corner < 1 << Dim; ++corner) {
			double part = 1;
			for (int a = 0; a < Dim; ++a) {
				const double begin = first[a] + (corner >> a & 1);
				part *= std::max(0., std::min(high[a], begin + 1) - std::max(low[a], begin));
			}
			cell_[corner]->covered += part;
		}
		int centre = 0;
		for (int a = 0; a < Dim; ++a)
			centre |= (x[a] >= first[a] + 1.) << a;
		cell_[centre]->hasCentre = true;
	}

private:
	void find(const Index<Dim>& first)
	{
		first_ = first;
		for (int corner = 0; corner < 1 << Dim; ++corner) {
			Index<Dim> cell = first;
			for (int a = 0; a < Dim; ++a)
				cell[a] += corner >> a & 1;
			cell_[corner] = &cells_[Grid<Dim>::key(cell)];
		}
	}

	Cells<Dim>&                 cells_;
	Index<Dim>                  first_;
	std::array<Cell*, 1 << Dim> cell_ {};
};

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
	Cells<Dim>    cells;
	Covering<Dim> covering(cells);
	for (std::size_t p = 0; p < centres.size(); ++p)
		covering.add(centres[p], halfLengths[p]);
	Coverage result;
	for (const auto& [key, cell] : cells) {
		result.populated += cell.hasCentre;
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
