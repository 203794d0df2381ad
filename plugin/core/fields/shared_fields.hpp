// SPDX-License-Identifier: GPL-2.0-or-later
// Vectors of several fields that processes assemble together.
#pragma once
#include "core/fields/dof_map.hpp"
#include "core/parallel/owned_nodes.hpp"

namespace gimpm {

/// Completes a vector with a block for each field, of so many unknowns a node: each process knows the rows of its
/// nodes, and then all.
inline void complete(const OwnedNodes& ownedNodes, const std::vector<int>& widths, Eigen::VectorXd& all)
{
	if (ownedNodes.isWhole()) return;
	if (widths.size() == 1) return ownedNodes.complete(all);
	Eigen::Index begin = 0;
	for (const int width : widths) {
		const Eigen::Index size  = Eigen::Index(width) * ownedNodes.start.back();
		Eigen::VectorXd    block = all.segment(begin, size);
		ownedNodes.complete(block);
		all.segment(begin, size) = block;
		begin += size;
	}
}

inline void complete(const OwnedNodes& ownedNodes, const DofMap& map, Eigen::VectorXd& all)
{
	std::vector<int> widths;
	for (int field = 0; field < map.fields(); ++field)
		widths.push_back(map[field].width);
	complete(ownedNodes, widths, all);
}

} // namespace gimpm
