// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/hanging_nodes.hpp"

namespace gimpm {
namespace {

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

} // namespace

template <int Dim> Masters mastersIn(const Refinement<Dim>& refinement, Key node)
{
	Masters masters;
	Resolver<Dim>(refinement, Grid<Dim>::layer(node)).add(Grid<Dim>::index(node), 1, masters);
	return masters;
}

template Masters mastersIn(const Refinement<2>&, Key);
template Masters mastersIn(const Refinement<3>&, Key);

} // namespace gimpm
