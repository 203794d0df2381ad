// SPDX-License-Identifier: GPL-2.0-or-later
// Unbounded background grid of square or cubic cells.
#pragma once
#include "core/base/types.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace gimpm {

/// Position of a key among sorted ones, or that at which it would be.
inline int position(const std::vector<Key>& sorted, Key key) { return int(std::lower_bound(sorted.begin(), sorted.end(), key) - sorted.begin()); }

/// Position of a key among sorted ones; -1: it is not there.
inline int find(const std::vector<Key>& sorted, Key key)
{
	const int index = position(sorted, key);
	return index < int(sorted.size()) && sorted[index] == key ? index : -1;
}

template <int Dim> class Refinement;
template <int Dim> class Parting;

template <int Dim> struct Grid {
	/// Edge length h of a cell, of the smallest ones where there are several sizes [m].
	double   cellSize = 1;
	Vec<Dim> origin   = Vec<Dim>::Zero(); ///< position of node (0, 0[, 0]) [m]
	/// Cells along each axis after which the grid repeats itself: nodes so far apart are one node, and so are
	/// cells. 0: it never does. The first ones, from 0 to period - 1, stand for all.
	Index<Dim> period = Index<Dim>::Zero();

	/// Body of revolution, in 2D: x is the distance from the axis, where x = 0 is on a node, and y goes along it.
	bool axisymmetric = false;

	/// Regions of smaller and larger cells; null: all cells are equal.
	std::shared_ptr<const Refinement<Dim>> refinement {};
	/// True if cells are halved anew in each step, so that bodies move by a large part of the smallest in a step.
	bool isAdaptive = false;

	/// Lines that part the body, in a grid of equal cells; null: there are none.
	std::shared_ptr<const Parting<Dim>> parting {};

	/// A domain and a ghost face reach three nodes along an axis, which must not be the same.
	static constexpr int smallestPeriod = 3;

	/// A key has the coordinates of a node or cell, its level, and above these the layer: bodies that meet have
	/// nodes and cells of their own, each in a layer. Neighbours by steps between keys are in the same one.
	static constexpr int keyBits   = Dim == 2 ? 28 : 19;
	static constexpr int levelBits = Dim == 2 ? 3 : 2, mostLevel = (1 << levelBits) - 1;
	static constexpr int mostLayer = (1 << (64 - keyBits * Dim - levelBits)) - 1;
	/// Integer coordinates must stay below this limit in magnitude; two cells of it, of the largest, are kept free
	/// for neighbours.
	static constexpr int endOfKeys = 1 << (keyBits - 1), indexLimit = endOfKeys - (2 << mostLevel);

	static constexpr int level(Key k) { return int(k >> (keyBits * Dim)) & mostLevel; }
	static constexpr int layer(Key k) { return int(k >> (keyBits * Dim + levelBits)); }
	double               size(int level) const { return cellSize * (1 << level); } ///< edge length of a cell [m]

	static constexpr Key keyStep(int axis, int level = 0) { return Key(1) << (keyBits * axis + level); }
	/// From a cell to the one above it along each axis whose bit is set.
	static constexpr Key keyOffset(int bits, int level = 0)
	{
		Key k = 0;
		for (int a = 0; a < Dim; ++a)
			if (bits >> a & 1) k += keyStep(a, level);
		return k;
	}
	static Key key(const Index<Dim>& i, int level = 0, int layer = 0)
	{
		Key k = Key(layer << levelBits | level) << (keyBits * Dim);
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
	bool isPeriodic() const { return !period.isZero(); }

	/// The node or cell that stands for this one and its images.
	Index<Dim> first(Index<Dim> i) const
	{
		for (int a = 0; a < Dim; ++a)
			if (period[a] != 0) i[a] -= period[a] * (i[a] / period[a] - (i[a] % period[a] < 0));
		return i;
	}
	Key first(Key k) const { return isPeriodic() ? key(first(index(k)), level(k), layer(k)) : k; }

	/// The image of a position whose coordinate is the nearest one to that of a node.
	double imageNear(double x, int node, int axis) const
	{
		if (period[axis] == 0) return x;
		const double length = cellSize * period[axis];
		return x + length * std::round((cellSize * node - x) / length);
	}
	/// Distance [cells] within which a coordinate lies on a line of the grid: 1e-9, and some round-off of the
	/// coordinate and of the origin, which is more where these are large, as on a map. 0 of an infinite one.
	double onLine(double x, int axis) const
	{
		constexpr double least = 1e-9, roundOff = 4 * std::numeric_limits<double>::epsilon();
		return std::isfinite(x) ? least + roundOff * (std::abs(x) + std::abs(origin[axis])) / cellSize : 0;
	}

	/// Number of the nodes on the axis.
	int      axisNode() const { return int(std::lround(-origin[0] / cellSize)); }
	Vec<Dim> nodePosition(const Index<Dim>& i) const { return origin + cellSize * i.template cast<double>(); }
};

} // namespace gimpm
