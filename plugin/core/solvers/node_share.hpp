// SPDX-License-Identifier: GPL-2.0-or-later
// Whose rows are whose, of a matrix over nodes that several processes assemble.
#pragma once
#include "core/base/processes.hpp"
#include <Eigen/Core>
#include <vector>

namespace gimpm {

/// Each process has a range of the nodes.
struct NodeShare {
	const Processes& processes;
	std::vector<int> start; ///< first node of each process; and the number of nodes

	int  first() const { return start[processes.rank()]; }
	int  last() const { return start[processes.rank() + 1]; }
	bool owns(int node) const { return node >= first() && node < last(); }

	/// The rows of this process of a vector over nodes.
	auto own(Eigen::VectorXd& nodal) const
	{
		const int dim = int(nodal.size() / start.back());
		return nodal.segment(dim * first(), dim * (last() - first()));
	}

	/// Of a vector over nodes each process knows its own rows, and then all.
	void complete(Eigen::VectorXd& nodal) const
	{
		std::vector<int> begin(start);
		for (int& row : begin)
			row *= int(nodal.size() / start.back());
		processes.gather(nodal.data(), begin.data());
	}
};

} // namespace gimpm
