// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/parting.hpp"
#include "core/grid/hanging_nodes.hpp"

namespace gimpm {
namespace {

/// True if the displacement in a leaf depends on a node.
template <int Dim> bool dependsOn(Key leaf, Key node, const Refinement<Dim>& refinement)
{
	for (int corner = 0; corner < 1 << Dim; ++corner)
		if (mastersIn(refinement, leaf + Grid<Dim>::keyOffset(corner, Grid<Dim>::level(leaf))).count(node)) return true;
	return false;
}

/// Adds the leaves within a cell whose displacement depends on a node.
template <int Dim> void addLeaves(Key cell, Key node, const Refinement<Dim>& refinement, std::vector<Key>& leaves)
{
	const int level = Grid<Dim>::level(cell);
	if (level == 0 || !refinement.isHalved(Grid<Dim>::index(cell), level)) {
		if (dependsOn(cell, node, refinement)) leaves.push_back(cell);
		return;
	}
	const Key lowest = Grid<Dim>::key(Grid<Dim>::index(cell), level - 1, Grid<Dim>::layer(cell));
	for (int child = 0; child < 1 << Dim; ++child)
		addLeaves(lowest + Grid<Dim>::keyOffset(child, level - 1), node, refinement, leaves);
}

/// Cells of nodes in their layers, in a refined grid leaves.
template <int Dim> std::vector<Key> cellsOf(const std::vector<Key>& nodes, const Refinement<Dim>* refinement)
{
	std::vector<Key> cells;
	for (const Key node : nodes)
		for (int corner = 0; corner < 1 << Dim; ++corner) {
			const Key cell = node - Grid<Dim>::keyOffset(corner, Grid<Dim>::level(node));
			if (refinement) addLeaves(cell, node, *refinement, cells);
			else
				cells.push_back(cell);
		}
	return cells;
}

} // namespace

template <int Dim> Parting<Dim>::Bits::Bits(std::vector<Key> keys, int bitsOfBodies)
{
	const auto ofBody = [&](Key key) { return in(Grid<Dim>::layer(key) & bitsOfBodies, key); };
	std::sort(keys.begin(), keys.end(), [&](Key a, Key b) { return ofBody(a) < ofBody(b); });
	for (const Key key : keys) {
		if (keys_.empty() || keys_.back() != ofBody(key)) keys_.push_back(ofBody(key)), bits_.push_back(0);
		bits_.back() |= Grid<Dim>::layer(key) & ~bitsOfBodies;
	}
}

template <int Dim>
Parting<Dim>::Parting(
        std::vector<Key> own, LayerAt layerAt, std::shared_ptr<const Refinement<Dim>> refinement, std::vector<LeakyCut<Dim>> leaks, int bitsOfBodies)
        : bitsOfBodies_(bitsOfBodies)
        , nodes_(own, bitsOfBodies)
        , cells_(cellsOf(own, refinement.get()), bitsOfBodies)
        , layerAt_(std::move(layerAt))
        , refinement_(std::move(refinement))
        , leaks_(std::move(leaks))
{
}

template class Parting<2>;
template class Parting<3>;

} // namespace gimpm
