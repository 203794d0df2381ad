// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/water/curves_at_nodes.hpp"
#include <map>

namespace gimpm {

template <int Dim> CurvesOfNodes::CurvesOfNodes(const std::vector<PorePoint>& points, const CloudBasis<Dim>& basis) : ofPoint_(points.size(), -1)
{
	std::map<const Retention*, int> known;
	for (std::size_t p = 0; p < points.size(); ++p) {
		if (hasCurveByPoint(*points[p].pores)) continue;
		const auto [found, isNew] = known.emplace(points[p].pores->retention, int(curves_.size()));
		if (isNew) curves_.push_back(found->first);
		ofPoint_[p] = found->second;
	}
	std::vector<std::vector<char>> isNeeded(curves_.size(), std::vector<char>(basis.nodes.size(), 0));
	for (const auto& patch : basis.patches)
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const int curve = ofPoint_[basis.order[i]];
			for (int n = 0; n < patchShapes<Dim>[patch.span].count && curve >= 0; ++n)
				if (patch.node[n] >= 0) isNeeded[curve][patch.node[n]] = 1;
		}
	nodes_.resize(curves_.size());
	for (std::size_t c = 0; c < curves_.size(); ++c)
		for (std::size_t n = 0; n < basis.nodes.size() && curves_[c]; ++n)
			if (isNeeded[c][n]) nodes_[c].push_back(int(n));
}

CurvesOfNodes::Wetness CurvesOfNodes::at(const Eigen::VectorXd& pressures) const
{
	Wetness all { { curves_.size(), std::vector<NodeWetness>(pressures.size()) }, pressures };
	for (std::size_t c = 0; c < curves_.size(); ++c) {
#pragma omp parallel for schedule(static)
		for (std::size_t i = 0; i < nodes_[c].size(); ++i) {
			const int n       = nodes_[c][i];
			all.byCurve[c][n] = { curves_[c]->saturation(pressures[n]), curves_[c]->relativePermeability(pressures[n]) };
		}
	}
	return all;
}

template CurvesOfNodes::CurvesOfNodes(const std::vector<PorePoint>&, const CloudBasis<2>&);
template CurvesOfNodes::CurvesOfNodes(const std::vector<PorePoint>&, const CloudBasis<3>&);

} // namespace gimpm
