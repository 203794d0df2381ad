// SPDX-License-Identifier: GPL-2.0-or-later
// Retention curves at the pressures of nodes, which the points of a soil share unless each has its own.
#pragma once
#include "core/terms/water/unsaturated_point.hpp"

namespace gimpm {

/// Retention curves of a body, and the nodes where each is needed.
class CurvesOfNodes {
public:
	/// Curves of points that follow each other; null: the pores are always full.
	template <int Dim> CurvesOfNodes(const std::vector<PorePoint>&, const CloudBasis<Dim>&);

	/// Values by curve and node; one for nodes where a curve is not needed, and for full pores.
	struct Wetness {
		std::vector<std::vector<NodeWetness>> byCurve {};
		Eigen::VectorXd                       pressures {};
	};
	Wetness at(const Eigen::VectorXd& pressures) const;

	/// Null for a point whose curve is its own.
	const std::vector<NodeWetness>* of(int point, const Wetness& all) const { return ofPoint_[point] < 0 ? nullptr : &all.byCurve[ofPoint_[point]]; }

private:
	std::vector<const Retention*> curves_;
	std::vector<int>              ofPoint_;
	std::vector<std::vector<int>> nodes_; // by curve
};

} // namespace gimpm
