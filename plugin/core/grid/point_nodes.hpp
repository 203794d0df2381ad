// SPDX-License-Identifier: GPL-2.0-or-later
// The basis functions of a point at the nodes of its patch, one number for each.
#pragma once
#include "core/grid/cloud_basis.hpp"

namespace gimpm {

/// Calls f(point of the basis, its patch, values in the order of the patch's nodes, their number) for the patches
/// [first, last).
template <int Dim, class F> void forPointNodes(const CloudBasis<Dim>& basis, int first, int last, F&& f)
{
	for (int i = first; i < last; ++i) {
		const Patch<Dim>& patch = basis.patches[i];
		int               count = 1;
		for (int a = 0; a < Dim; ++a)
			count *= patch.nodesAlong(a);
		for (int p = patch.first; p < patch.first + patch.count; ++p) {
			double value[windowNodes<Dim>];
			for (int n = 0; n < count; ++n) {
				value[n] = 1;
				for (int a = 0, rest = n; a < Dim; rest /= patch.nodesAlong(a), ++a)
					value[n] *= basis.axes[p][a].value[rest % patch.nodesAlong(a)];
			}
			f(p, patch, value, count);
		}
	}
}

/// The same for all patches from several threads, so that no two work on the same node at a time; the order of sums
/// does not depend on their number.
template <int Dim, class F> void forPointNodes(const CloudBasis<Dim>& basis, F&& f)
{
	for (const auto& colour : basis.colours) {
#pragma omp parallel for schedule(dynamic)
		for (std::size_t range = 0; range < colour.size(); ++range)
			forPointNodes(basis, colour[range].first, colour[range].second, f);
	}
}

/// Value at a point that forPointNodes() calls f for, of values at the nodes with Dim components each.
template <int Dim> Vec<Dim> atPoint(const Patch<Dim>& patch, const double* value, int count, const Eigen::VectorXd& nodal)
{
	Vec<Dim> sum = Vec<Dim>::Zero();
	for (int n = 0; n < count; ++n)
		if (patch.node[n] >= 0) sum += value[n] * nodal.template segment<Dim>(Dim * patch.node[n]);
	return sum;
}

} // namespace gimpm
