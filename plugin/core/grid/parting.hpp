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

/// Points near a line and on its one side have nodes in a layer of their own (Grid::layer), a number with one bit.
/// Those whose cells the line cuts through are nodes of their own: displacements jump there (Hansbo and Hansbo 2004).
/// The others are tied to the nodes of layer 0 in their places, and a cell without functions of such nodes is the one
/// of layer 0: so soil is one body around the ends of the line. Beside several lines a layer has the bits of all of
/// them, and a node, or a cell, is the one of those bits of the lines that cut it. In a refined grid hanging nodes are
/// tied within their layer first. Where bodies of points have layers, the lowest bits of a layer are those of its body,
/// whose nodes are apart everywhere.
template <int Dim> class Parting {
public:
	/// Layer at a position of soil: of that of a body, or, where its layer is -1, of any.
	using LayerAt = std::function<int(const Vec<Dim>& position, int ofBody)>;

	/// Keys of the nodes that lines cut, each in the layer of a line, none of them hanging; and the layer of a
	/// point by its position. Null: the cells are equal. `bitsOfBodies`: bits of the layers that bodies have.
	Parting(std::vector<Key> own, LayerAt, std::shared_ptr<const Refinement<Dim>> refinement = {}, std::vector<LeakyCut<Dim>> leaks = {},
	        int bitsOfBodies = 0);

	int                               layerAt(const Vec<Dim>& position, int ofBody = -1) const { return layerAt_(position, ofBody); }
	int                               layerOfBody(int layer) const { return layer & bitsOfBodies_; }
	const std::vector<LeakyCut<Dim>>& leaks() const { return leaks_; }

	/// The key in the layer of its body.
	Key ofBody(Key key) const { return in(layerOfBody(Grid<Dim>::layer(key)), key); }

	static Key in(int layer, Key key) { return Grid<Dim>::key(Grid<Dim>::index(key), Grid<Dim>::level(key), layer); }

	/// True if lines cut what a node, in any layer of its body, stands for.
	bool isCut(Key node) const { return nodes_.bitsOf(ofBody(node)) != 0; }
	/// True of folds, whose sides may have other layers in the next step.
	bool isOfFolds() const { return bitsOfBodies_ > 0; }

	bool isOwn(Key node) const { return Grid<Dim>::layer(node) > 0 && nodeFor(node) == node; }
	/// The node that stands for one of a layer that does not hang.
	Key nodeFor(Key node) const { return in(Grid<Dim>::layer(node) & (bitsOfBodies_ | nodes_.bitsOf(ofBody(node))), node); }
	/// The cell that stands for one of a layer, in a refined grid a leaf or a part of one.
	Key cellFor(Key cell) const { return in(Grid<Dim>::layer(cell) & (bitsOfBodies_ | bitsOf(cell)), cell); }

	/// Calls f(cell beyond a face, layer of the face) by a cell and the one beyond, in its layer: for the one that
	/// stands for this, and those on all sides of the lines that begin there.
	template <class F> void forSidesBeyond(Key cell, Key beyond, F&& f) const
	{
		const int layer = Grid<Dim>::layer(cell), there = bitsOf(beyond), begins = there & ~bitsOf(cell);
		for (int sides = 0;; sides = (sides - begins) & begins) { // all parts of these bits
			f(in((layer & (bitsOfBodies_ | there)) | sides, beyond), layer | sides);
			if (sides == begins) return;
		}
	}

private:
	/// Bits of the lines that cut what keys in the layers of bodies stand for.
	class Bits {
	public:
		/// Takes keys in layers of one bit, beside those of bodies.
		Bits(std::vector<Key> keys, int bitsOfBodies);
		int bitsOf(Key key) const
		{
			const int found = find(keys_, key);
			return found < 0 ? 0 : bits_[found];
		}

	private:
		std::vector<Key> keys_;
		std::vector<int> bits_;
	};

	/// Lines whose nodes have functions in a cell.
	int bitsOf(Key cell) const
	{
		const Key first = ofBody(cell);
		return cells_.bitsOf(refinement_ ? refinement_->leafOf(first) : first);
	}

	int                                    bitsOfBodies_;
	Bits                                   nodes_, cells_; // in a refined grid leaves
	LayerAt                                layerAt_;
	std::shared_ptr<const Refinement<Dim>> refinement_;
	std::vector<LeakyCut<Dim>>             leaks_;
};

} // namespace gimpm
