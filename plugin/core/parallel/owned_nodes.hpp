// SPDX-License-Identifier: GPL-2.0-or-later
// Owners of the rows of vectors and matrices over nodes that processes assemble together.
#pragma once
#include "core/parallel/processes.hpp"
#include <Eigen/Core>
#include <utility>
#include <vector>

namespace gimpm {

/// Each process has a range of the nodes; one that is alone has all.
struct OwnedNodes {
	const Processes& processes;
	std::vector<int> start; ///< first node of each process; and the number of nodes

	int  first() const { return start[processes.rank()]; }
	int  last() const { return start[processes.rank() + 1]; }
	bool owns(int node) const { return node >= first() && node < last(); }
	bool isWhole() const { return processes.size() == 1; } ///< all rows are here

	/// Range of the rows, as pairs of numbers.
	std::pair<int, int> range() const { return { first(), last() }; }

	/// Share of a process that has all rows, however many.
	static OwnedNodes whole(int nodes = 0) { return { *Processes::alone(), { 0, nodes } }; }

	/// The rows of this process of a vector over nodes.
	auto own(Eigen::VectorXd& nodal) const
	{
		const int dim = int(nodal.size() / start.back());
		return nodal.segment(dim * first(), dim * (last() - first()));
	}

	/// Completes a vector over nodes: each process knows its own rows, and then all.
	void complete(Eigen::VectorXd& nodal) const { complete(nodal.data(), nodal.size()); }
	void complete(std::vector<double>& nodal) const { complete(nodal.data(), Eigen::Index(nodal.size())); }

private:
	void complete(double* nodal, Eigen::Index size) const
	{
		if (isWhole()) return;
		std::vector<int> begin(start);
		for (int& row : begin)
			row *= int(size / start.back());
		processes.gather(nodal, begin.data());
	}
};

} // namespace gimpm
