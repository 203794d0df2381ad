// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <numeric>
#include <vector>

namespace gimpm {

/// Disjoint sets of numbers.
class DisjointSets {
public:
	explicit DisjointSets(int count) : above_(count) { std::iota(above_.begin(), above_.end(), 0); }

	int root(int i)
	{
		while (above_[i] != i)
			i = above_[i] = above_[above_[i]];
		return i;
	}
	void join(int i, int j) { above_[std::max(root(i), root(j))] = std::min(root(i), root(j)); }

	/// Numbers of the sets, in the order of their first members.
	std::vector<int> numbers()
	{
		std::vector<int> found(above_.size()), number(above_.size(), -1);
		for (int i = 0, next = 0; i < int(above_.size()); ++i) {
			int& own = number[root(i)];
			if (own < 0) own = next++;
			found[i] = own;
		}
		return found;
	}

private:
	std::vector<int> above_;
};

} // namespace gimpm
