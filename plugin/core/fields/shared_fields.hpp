// SPDX-License-Identifier: GPL-2.0-or-later
// Vectors of several fields that processes assemble together.
#pragma once
#include "core/fields/dof_map.hpp"
#include "core/parallel/node_share.hpp"

namespace gimpm {

/// Of a vector with a block for each field, of so many unknowns a node, each process knows the rows of its nodes, and
/// then all.
inline void complete(const NodeShare& share, const std::vector<int>& widths, Eigen::VectorXd& all)
{
	if (share.isWhole()) return;
	if (widths.size() == 1) return share.complete(all);
	Eigen::Index begin = 0;
	for (const int width : widths) {
		const Eigen::Index size  = Eigen::Index(width) * share.start.back();
		Eigen::VectorXd    block = all.segment(begin, size);
		share.complete(block);
		all.segment(begin, size) = block;
		begin += size;
	}
}

inline void complete(const NodeShare& share, const DofMap& map, Eigen::VectorXd& all)
{
	std::vector<int> widths;
	for (int field = 0; field < map.fields(); ++field)
		widths.push_back(map[field].width);
	complete(share, widths, all);
}

} // namespace gimpm
