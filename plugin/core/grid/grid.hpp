// SPDX-License-Identifier: GPL-2.0-or-later
// Unbounded background grid of square or cubic cells.
#pragma once
#include "core/base/types.hpp"
#include <algorithm>
#include <cmath>
#include <vector>

namespace gimpm {

/// Sortable name of a cell or node: its integer coordinates packed so that x runs fastest. A cell is named after its lowest node,
/// and the key of a neighbour is the key plus a constant, whatever the place in the grid.
using Key = std::uint64_t;

/// Where a key stands among sorted ones, or would stand.
inline int position(const std::vector<Key>& sorted, Key key) { return int(std::lower_bound(sorted.begin(), sorted.end(), key) - sorted.begin()); }

template <int Dim> struct Grid {
	double   cellSize = 1;                ///< edge length h of a cell [m]
	Vec<Dim> origin   = Vec<Dim>::Zero(); ///< position of node (0, 0[, 0]) [m]

	static constexpr int keyBits = Dim == 2 ? 31 : 21;
	/// Integer coordinates must stay below this limit in magnitude; two cells of it are kept free for neighbours.
	static constexpr int indexLimit = (1 << (keyBits - 1)) - 2;

	static constexpr Key keyStep(int axis) { return Key(1) << (keyBits * axis); }
	/// From a cell to the one above it along each axis whose bit is set.
	static constexpr Key keyOffset(int bits)
	{
		Key k = 0;
		for (int a = 0; a < Dim; ++a)
			if (bits >> a & 1) k += keyStep(a);
		return k;
	}
	static Key key(const Index<Dim>& i)
	{
		Key k = 0;
		for (int a = 0; a < Dim; ++a)
			k += Key(std::int64_t(i[a]) + (std::int64_t(1) << (keyBits - 1))) << (keyBits * a);
		return k;
	}
	static Index<Dim> index(Key k)
	{
		Index<Dim> i;
		for (int a = 0; a < Dim; ++a)
			i[a] = int(std::int64_t((k >> (keyBits * a)) & ((Key(1) << keyBits) - 1)) - (std::int64_t(1) << (keyBits - 1)));
		return i;
	}
	Vec<Dim> nodePosition(const Index<Dim>& i) const { return origin + cellSize * i.template cast<double>(); }
};

} // namespace gimpm
