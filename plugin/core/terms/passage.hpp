// SPDX-License-Identifier: GPL-2.0-or-later
// Water that passes from a body of soil to one that has nodes of its own.
#pragma once
#include "core/grid/attachment.hpp"
#include "core/terms/coupled_term.hpp"
#include <array>

namespace gimpm {

/// Conductance of what is hardly a way through soil, over its conductivity and the cell size: as of a drain's skin.
constexpr double conductanceOfSoil = 30;

/// Between two positions that face each other.
template <int Dim> struct Passage {
	static constexpr int field = 1; ///< of the pressures

	std::array<Attachment<Dim>, 2> at;
	double                         conductance; ///< [m3/Pa] in the step

	void mark(Couplings& K) const
	{
		for (const auto& one : at)
			for (const auto& other : at)
				for (const int a : one.node)
					for (const int b : other.node)
						K.mark({ field, a }, { field, b });
	}
	void add(const Eigen::VectorXd& P, const FieldSum<Dim>& sum) const
	{
		const double first = at[0].value(P), second = at[1].value(P);
		for (const int i : { 0, 1 })
			for (int m = 0; m < at[i].nodes; ++m) {
				const int    row    = at[i].node[m];
				const double leaves = (i == 0 ? 1 : -1) * conductance * at[i].weight[m];
				sum.force[field][row] += leaves * (first - second);
				sum.absoluteContributions[field][row] += std::abs(leaves) * (std::abs(first) + std::abs(second));
				for (const int j : { 0, 1 })
					for (int n = 0; n < at[j].nodes && sum.couplings; ++n)
						sum.couplings->add({ field, row }, { field, at[j].node[n] }, (j == 0 ? 1 : -1) * leaves * at[j].weight[n]);
			}
	}
};

} // namespace gimpm
