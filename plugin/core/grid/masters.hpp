// SPDX-License-Identifier: GPL-2.0-or-later
// Master nodes that replace tied nodes in matrices.
#pragma once
#include "core/grid/affine_constraints.hpp"

namespace gimpm {

/// Master nodes of each node, with their weights; a node that is not tied is its own master.
class MastersOf {
public:
	/// Null: nothing is tied. The ties must outlive it.
	MastersOf(int nodes, const AffineConstraints* affineConstraints) : affineConstraints_(affineConstraints), tie_(nodes, -1)
	{
		for (std::size_t t = 0; affineConstraints && t < affineConstraints->node.size(); ++t)
			tie_[affineConstraints->node[t]] = int(t);
	}

	/// Calls f(node, weight).
	template <class F> void each(int node, F&& f) const
	{
		if (tie_[node] < 0) return f(node, 1.);
		for (int m = affineConstraints_->start[tie_[node]]; m < affineConstraints_->start[tie_[node] + 1]; ++m)
			f(affineConstraints_->master[m], affineConstraints_->weight[m]);
	}
	/// Calls f(node, node, product of weights) for what a pair of nodes stands for.
	template <class F> void eachPair(int a, int b, F&& f) const
	{
		each(a, [&](int m, double ofA) { each(b, [&](int n, double ofB) { f(m, n, ofA * ofB); }); });
	}

private:
	const AffineConstraints* affineConstraints_;
	std::vector<int>         tie_;
};

} // namespace gimpm
