// SPDX-License-Identifier: GPL-2.0-or-later
// Nodes that are there twice, because a line parts the points on its two sides.
#pragma once
#include "core/grid/grid.hpp"
#include <functional>
#include <limits>

namespace gimpm {

/// A part of a cut by which water passes from the soil to its left, in layer 0, to that to its right.
template <int Dim> struct LeakyCut {
	static constexpr double asSoil = std::numeric_limits<double>::infinity(); ///< leakage ahead of a tip, where soil is whole

	Vec<Dim> from, to;
	int      layer;
	double   leakage; ///< volume that passes by area and time, over the difference of the pressures [m3/(N s)]
};

/// Points near a line and on its one side have nodes in a layer of their own (Grid::layer). Those whose cells the line
/// cuts through are nodes of their own: displacements jump there (Hansbo and Hansbo 2004). The others are tied to the
/// nodes of layer 0 in their places, and a cell that has only such corners is the one of layer 0: so soil is one body
/// around the ends of the line.
template <int Dim> class Parting {
public:
	/// Keys of the nodes of their own, sorted, all in layers above 0; and the layer of a point by its position.
	Parting(std::vector<Key> own, std::function<int(const Vec<Dim>&)> layerAt, std::vector<LeakyCut<Dim>> leaks)
	        : own_(std::move(own)), layerAt_(std::move(layerAt)), leaks_(std::move(leaks))
	{
		for (const Key node : own_)
			if (layers_.empty() || layers_.back() != Grid<Dim>::layer(node)) layers_.push_back(Grid<Dim>::layer(node));
	}

	int                               layerAt(const Vec<Dim>& position) const { return layerAt_(position); }
	const std::vector<LeakyCut<Dim>>& leaks() const { return leaks_; }

	static Key in(int layer, Key key) { return Grid<Dim>::key(Grid<Dim>::index(key), Grid<Dim>::level(key), layer); }

	bool isOwn(Key node) const { return find(own_, node) >= 0; }
	/// The node or cell that stands for one of a layer.
	Key nodeFor(Key node) const { return isOwn(node) ? node : in(0, node); }
	Key cellFor(Key cell) const { return hasOwnCorner(cell) ? cell : in(0, cell); }

	/// Calls f(cell beyond a face of a cell, layer of the face): the one of its own layer, and from a cell of layer
	/// 0 without corners of their own those of all layers.
	template <class F> void forCellsBeyond(Key cell, int axis, bool isAbove, F&& f) const
	{
		const Key step = Grid<Dim>::keyStep(axis), beyond = isAbove ? cell + step : cell - step;
		f(cellFor(beyond), Grid<Dim>::layer(cell));
		if (Grid<Dim>::layer(cell) > 0) return;
		for (const int layer : layers_)
			if (!hasOwnCorner(in(layer, cell)) && hasOwnCorner(in(layer, beyond))) f(in(layer, beyond), layer);
	}

private:
	bool hasOwnCorner(Key cell) const
	{
		for (int corner = 0; corner < 1 << Dim; ++corner)
			if (isOwn(cell + Grid<Dim>::keyOffset(corner))) return true;
		return false;
	}

	std::vector<Key>                    own_;
	std::function<int(const Vec<Dim>&)> layerAt_;
	std::vector<LeakyCut<Dim>>          leaks_;
	std::vector<int>                    layers_;
};

} // namespace gimpm
