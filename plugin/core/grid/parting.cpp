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

} // namespace

template <int Dim>
Parting<Dim>::Parting(
        std::vector<Key> own, std::function<int(const Vec<Dim>&)> layerAt, std::shared_ptr<const Refinement<Dim>> refinement, std::vector<LeakyCut<Dim>> leaks)
        : own_(std::move(own)), layerAt_(std::move(layerAt)), refinement_(std::move(refinement)), leaks_(std::move(leaks))
{
	for (const Key node : own_) {
		if (layers_.empty() || layers_.back() != Grid<Dim>::layer(node)) layers_.push_back(Grid<Dim>::layer(node));
		for (int corner = 0; corner < 1 << Dim; ++corner) {
			const Key cell = node - Grid<Dim>::keyOffset(corner, Grid<Dim>::level(node));
			if (refinement_) addLeaves(cell, node, *refinement_, cells_);
			else
				cells_.push_back(cell);
		}
	}
	std::sort(cells_.begin(), cells_.end());
	cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
}

template class Parting<2>;
template class Parting<3>;

} // namespace gimpm
