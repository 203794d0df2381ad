// SPDX-License-Identifier: GPL-2.0-or-later
// What tied nodes stand for in matrices.
#pragma once
#include "core/grid/ties.hpp"

namespace gimpm {

/// What a node stands for among the nodes that are not tied.
class MastersOf {
public:
	/// Null: nothing is tied. The ties must outlive it.
	MastersOf(int nodes, const Ties* ties) : ties_(ties), tie_(nodes, -1)
	{
		for (std::size_t t = 0; ties && t < ties->node.size(); ++t)
			tie_[ties->node[t]] = int(t);
	}

	/// Calls f(node, weight).
	template <class F> void each(int node, F&& f) const
	{
		if (tie_[node] < 0) return f(node, 1.);
		for (int m = ties_->start[tie_[node]]; m < ties_->start[tie_[node] + 1]; ++m)
			f(ties_->master[m], ties_->weight[m]);
	}
	/// Calls f(node, node, product of weights) for what a pair of nodes stands for.
	template <class F> void eachPair(int a, int b, F&& f) const
	{
		each(a, [&](int m, double ofA) { each(b, [&](int n, double ofB) { f(m, n, ofA * ofB); }); });
	}

private:
	const Ties*      ties_;
	std::vector<int> tie_;
};

} // namespace gimpm
