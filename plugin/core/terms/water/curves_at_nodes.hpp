// SPDX-License-Identifier: GPL-2.0-or-later
// Retention curves at the pressures of nodes, which all points of a soil share.
#pragma once
#include "core/terms/water/unsaturated_point.hpp"

namespace gimpm {

/// Retention curves of a body, and the nodes where each is needed.
class CurvesOfNodes {
public:
	/// Curves of points that follow each other; null: the pores are always full.
	template <int Dim> CurvesOfNodes(const std::vector<PorePoint>&, const CloudBasis<Dim>&);

	/// Values by curve and node; one for nodes where a curve is not needed, and for full pores.
	using Wetness = std::vector<std::vector<NodeWetness>>;
	Wetness at(const Eigen::VectorXd& pressures) const;

	const std::vector<NodeWetness>& of(int point, const Wetness& all) const { return all[ofPoint_[point]]; }

private:
	std::vector<const Retention*> curves_;
	std::vector<int>              ofPoint_;
	std::vector<std::vector<int>> nodes_; // by curve
};

} // namespace gimpm
