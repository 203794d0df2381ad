// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/contact/force_distribution.hpp"
#include <algorithm>
#include <cmath>

namespace gimpm {
namespace {

/// Functions along one axis.
struct AlongAxis {
	int                   from, count = 2; // lowest node; nodes
	std::array<double, 3> weight {};
};

template <int Dim> double inCell(const Attachment<Dim>& attachment, int axis) { return attachment.inCell()[axis] / (1 << attachment.level); }

AlongAxis linear(int cell, double local) { return { cell, 2, { 1 - local, local, 0 } }; }

/// Weights along an axis with this part of the splines.
AlongAxis weightsAlong(int cell, double local, double share)
{
	const bool   isLow = local < 0.5;
	const double t     = isLow ? local : local - 1; // from the centre one of the three nodes
	AlongAxis    f { cell - isLow, 3, { (0.5 - t) * (0.5 - t) / 2, 0.75 - t * t, (0.5 + t) * (0.5 + t) / 2 } };
	for (double& weight : f.weight)
		weight *= share;
	f.weight[isLow] += (1 - share) * (1 - local), f.weight[isLow + 1] += (1 - share) * local;
	return f;
}

/// Mirror image of a node, if it is beyond a plane of symmetry at the face of a cell on this side; 0: there is none.
int image(int node, int cell, int mirror)
{
	if (mirror < 0) return std::max(node, 2 * cell - node);
	return mirror > 0 ? std::min(node, 2 * (cell + 1) - node) : node;
}

} // namespace

template <int Dim> int sideInCell(const Attachment<Dim>& attachment, int axis)
{
	const double local = inCell(attachment, axis);
	if (local < 0 || local > 1 || std::abs(local - 0.5) < 1e-9) return 0;
	return local < 0.5 ? -1 : 1;
}

template <int Dim>
ForceDistribution<Dim>::ForceDistribution(
        const Attachment<Dim>& attachment, const Vec<Dim>& shares, const CloudBasis<Dim>& basis, const Grid<Dim>& grid, int layer, const Index<Dim>& mirrors)
        : ForceDistribution(attachment)
{
	std::array<AlongAxis, Dim> along;
	for (int a = 0; a < Dim; ++a)
		along[a] = linear(attachment.cell[a], inCell(attachment, a));
	for (int a = 0; a < Dim; ++a) {
		if (!(shares[a] > 0) || sideInCell(attachment, a) == 0) continue;
		const AlongAxis kept = along[a];
		along[a]             = weightsAlong(attachment.cell[a], inCell(attachment, a), shares[a]);
		ForceDistribution wider;
		bool              isThere = true;
		Index<Dim>        i       = Index<Dim>::Zero();
		for (int b = 0; b < Dim && isThere;) {
			const int n     = wider.nodes++;
			wider.weight[n] = 1;
			for (int c = 0; c < Dim; ++c)
				wider.at[n][c] = image(along[c].from + i[c], attachment.cell[c], mirrors[c]), wider.weight[n] *= along[c].weight[i[c]];
			wider.node[n] = find(basis.nodes, Grid<Dim>::key(grid.first(wider.at[n] * (1 << attachment.level)), attachment.level, layer));
			isThere       = wider.node[n] >= 0;
			for (b = 0; b < Dim && ++i[b] == along[b].count; ++b)
				i[b] = 0;
		}
		if (isThere) *this = wider;
		else
			along[a] = kept;
	}
}

template struct ForceDistribution<2>;
template struct ForceDistribution<3>;
template int sideInCell(const Attachment<2>&, int);
template int sideInCell(const Attachment<3>&, int);

} // namespace gimpm
