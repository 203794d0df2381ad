// SPDX-License-Identifier: GPL-2.0-or-later
// Nodes that are there twice, because a line parts the points on its two sides.
#pragma once
#include "core/grid/refinement.hpp"
#include <array>
#include <functional>
#include <limits>

namespace gimpm {

/// A part of a cut by which water passes from the soil to its left, in layer 0, to that to its right.
template <int Dim> struct LeakyCut {
	static constexpr double asSoil = std::numeric_limits<double>::infinity(); ///< leakage ahead of a tip, where soil is whole

	std::array<Vec<Dim>, Dim> corners;
	int                       layer;
	double                    leakage; ///< volume that passes by area and time, over the difference of the pressures [m3/(N s)]
};

/// Points near a line and on its one side have nodes in a layer of their own (Grid::layer). Those whose cells the line
/// cuts through are nodes of their own: displacements jump there (Hansbo and Hansbo 2004). The others are tied to the
/// nodes of layer 0 in their places, and a cell without functions of such nodes is the one of layer 0: so soil is one
/// body around the ends of the line. In a refined grid hanging nodes are tied within their layer first.
template <int Dim> class Parting {
public:
	/// Keys of the nodes of their own, sorted, all in layers above 0 and not hanging; and the layer of a point by
	/// its position. Null: the cells are equal.
	Parting(std::vector<Key> own, std::function<int(const Vec<Dim>&)> layerAt, std::shared_ptr<const Refinement<Dim>> refinement = {},
	        std::vector<LeakyCut<Dim>> leaks = {});

	int                               layerAt(const Vec<Dim>& position) const { return layerAt_(position); }
	const std::vector<LeakyCut<Dim>>& leaks() const { return leaks_; }

	static Key in(int layer, Key key) { return Grid<Dim>::key(Grid<Dim>::index(key), Grid<Dim>::level(key), layer); }

	bool isOwn(Key node) const { return find(own_, node) >= 0; }
	/// The node that stands for one of a layer that does not hang.
	Key nodeFor(Key node) const { return isOwn(node) ? node : in(0, node); }
	/// The cell that stands for one of a layer, in a refined grid a leaf or a part of one.
	Key cellFor(Key cell) const { return hasOwnNode(cell) ? cell : in(0, cell); }

	/// Calls f(cell beyond a face, layer of the face) by a cell and the one beyond, in its layer: for the one that
	/// stands for this, and from a cell of layer 0 without nodes of their own for those of all layers.
	template <class F> void forSidesBeyond(Key cell, Key beyond, F&& f) const
	{
		f(cellFor(beyond), Grid<Dim>::layer(cell));
		if (Grid<Dim>::layer(cell) > 0) return;
		for (const int layer : layers_)
			if (!hasOwnNode(in(layer, cell)) && hasOwnNode(in(layer, beyond))) f(in(layer, beyond), layer);
	}

private:
	/// True if a function of an own node is in a cell.
	bool hasOwnNode(Key cell) const
	{
		if (Grid<Dim>::layer(cell) == 0) return false;
		return find(cells_, refinement_ ? refinement_->leafOf(cell) : cell) >= 0;
	}

	std::vector<Key>                       own_, cells_; // cells with own nodes, in a refined grid leaves, sorted
	std::function<int(const Vec<Dim>&)>    layerAt_;
	std::shared_ptr<const Refinement<Dim>> refinement_;
	std::vector<LeakyCut<Dim>>             leaks_;
	std::vector<int>                       layers_;
};

} // namespace gimpm
