// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/grid/cells_around.hpp"
#include "core/grid/grid.hpp"
#include <unordered_map>

namespace gimpm {

/// Numbers by the cells of an edge length that have them.
template <int Dim> class ByCell {
public:
	ByCell(const Vec<Dim>& origin, double size) : origin_(origin), size_(size) { }

	Index<Dim> cell(const Vec<Dim>& x) const { return ((x - origin_) / size_).array().floor().template cast<int>(); }
	void       add(const Index<Dim>& cell, int number) { numbers_[Grid<Dim>::key(cell)].push_back(number); }

	const std::vector<int>& in(const Index<Dim>& cell) const
	{
		static const std::vector<int> none;
		const auto                    found = numbers_.find(Grid<Dim>::key(cell));
		return found == numbers_.end() ? none : found->second;
	}
	template <class F> void forAll(const Index<Dim>& cell, F&& f) const
	{
		for (const int number : in(cell))
			f(number);
	}
	/// Calls f(number) for those of the cell of a position and the cells around it.
	template <class F> void forNear(const Vec<Dim>& x, F&& f) const
	{
		for (int n = 0; n < cellsAround<Dim>; ++n)
			forAll(cell(x) + offsetAround<Dim>(n), f);
	}

private:
	Vec<Dim>                                  origin_;
	double                                    size_;
	std::unordered_map<Key, std::vector<int>> numbers_;
};

} // namespace gimpm
