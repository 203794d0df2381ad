// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/affine_constraints.hpp"
#include <map>

namespace gimpm {
namespace {

using Masters = std::map<Key, double>;

template <int Dim> class Resolver {
public:
	Resolver(const Refinement<Dim>& refinement, int layer) : refinement_(refinement), layer_(layer) { }

	/// Adds `share` of what the position of a node depends on.
	void add(const Index<Dim>& node, double share, Masters& masters) const
	{
		const int        level = refinement_.largestAt(node);
		const Index<Dim> low   = node.unaryExpr([&](int i) { return floorTo(i, level); });
		const Vec<Dim>   xi    = (node - low).template cast<double>() / (1 << level);
		if (xi.isZero(0)) {
			masters[Grid<Dim>::key(node, level, layer_)] += share;
			return;
		}
		for (int c = 0; c < 1 << Dim; ++c) {
			Index<Dim> corner = low;
			double     weight = share;
			for (int a = 0; a < Dim; ++a) {
				corner[a] += (c >> a & 1) << level;
				weight *= c >> a & 1 ? xi[a] : 1 - xi[a];
			}
			if (weight > 0) add(corner, weight, masters);
		}
	}

private:
	const Refinement<Dim>& refinement_;
	const int              layer_;
};

void addKeys(std::vector<Key>& sorted, const std::vector<Key>& others)
{
	sorted.insert(sorted.end(), others.begin(), others.end());
	std::sort(sorted.begin(), sorted.end());
	sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
}

} // namespace

template <int Dim> AffineConstraints tieNodes(std::vector<Key>& nodes, const Refinement<Dim>& refinement)
{
	std::vector<std::pair<Key, Masters>> tied;
	std::vector<Key>                     masters;
	for (const Key node : nodes) {
		Masters found;
		Resolver<Dim>(refinement, Grid<Dim>::layer(node)).add(Grid<Dim>::index(node), 1, found);
		if (found.count(node)) continue;
		for (const auto& [master, weight] : found)
			masters.push_back(master);
		tied.emplace_back(node, std::move(found));
	}
	addKeys(nodes, masters);
	AffineConstraints affineConstraints;
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

template <int Dim> AffineConstraints tieNodes(std::vector<Key>& nodes, const Parting<Dim>& parting)
{
	std::vector<Key> tied, masters;
	for (const Key node : nodes)
		if (const Key master = parting.nodeFor(node); master != node) {
			tied.push_back(node);
			masters.push_back(master);
		}
	addKeys(nodes, masters);
	AffineConstraints affineConstraints;
	for (std::size_t t = 0; t < tied.size(); ++t) {
		affineConstraints.node.push_back(position(nodes, tied[t]));
		affineConstraints.master.push_back(position(nodes, masters[t]));
		affineConstraints.weight.push_back(1);
		affineConstraints.start.push_back(int(t) + 1);
	}
	return affineConstraints;
}

template AffineConstraints tieNodes(std::vector<Key>&, const Refinement<2>&);
template AffineConstraints tieNodes(std::vector<Key>&, const Refinement<3>&);
template AffineConstraints tieNodes(std::vector<Key>&, const Parting<2>&);
template AffineConstraints tieNodes(std::vector<Key>&, const Parting<3>&);

} // namespace gimpm
