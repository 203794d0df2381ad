// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/affine_constraints.hpp"
#include "core/grid/hanging_nodes.hpp"

namespace gimpm {
namespace {

void addKeys(std::vector<Key>& sorted, const std::vector<Key>& others)
{
	sorted.insert(sorted.end(), others.begin(), others.end());
	std::sort(sorted.begin(), sorted.end());
	sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
}

/// Masters of a node: of a hanging one those in its layer, and of each of them the one that stands for it.
template <int Dim> Masters mastersOf(Key node, const Grid<Dim>& grid)
{
	Masters found = grid.refinement ? mastersIn(*grid.refinement, node) : Masters { { node, 1. } };
	if (!grid.parting || Grid<Dim>::layer(node) == 0) return found;
	Masters those;
	for (const auto& [master, weight] : found)
		those[grid.parting->nodeFor(master)] += weight;
	return those;
}

} // namespace

template <int Dim> AffineConstraints tieNodes(std::vector<Key>& nodes, const Grid<Dim>& grid)
{
	AffineConstraints affineConstraints;
	if (!grid.refinement && !grid.parting) return affineConstraints;
	std::vector<std::pair<Key, Masters>> tied;
	std::vector<Key>                     masters;
	for (const Key node : nodes) {
		Masters found = mastersOf(node, grid);
		if (found.count(node)) continue;
		for (const auto& [master, weight] : found)
			masters.push_back(master);
		tied.emplace_back(node, std::move(found));
	}
	addKeys(nodes, masters);
	for (const auto& [node, found] : tied) {
		affineConstraints.node.push_back(position(nodes, node));
		for (const auto& [master, weight] : found) {
			affineConstraints.master.push_back(position(nodes, master));
			affineConstraints.weight.push_back(weight);
		}
		affineConstraints.start.push_back(int(affineConstraints.master.size()));
	}
	return affineConstraints;
}

template AffineConstraints tieNodes(std::vector<Key>&, const Grid<2>&);
template AffineConstraints tieNodes(std::vector<Key>&, const Grid<3>&);

} // namespace gimpm
