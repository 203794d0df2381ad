// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/points/centres.hpp"
#include "core/terms/parts_in_cells.hpp"

namespace gimpm {
namespace {

/// Centre of the matter in each cell, in the cell: 0 to 1 along each axis.
template <int Dim> std::vector<Vec<Dim>> centresOfMatter(const PointCloud<Dim>& cloud, const CloudBasis<Dim>& basis)
{
	std::vector<Vec<Dim>> centre(basis.cells.size(), Vec<Dim>::Zero());
	std::vector<double>   volume(basis.cells.size(), 0);
	for (const auto& patch : basis.patches)
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const int    p   = basis.order[i];
			const double own = cloud.volume0[p] * cloud.volumeRatio(p);
			forParts(patch, basis.axes[i], [&](int c, int cell, const auto& parts, double share) {
				volume[cell] += own * share;
				for (int a = 0; a < Dim; ++a)
					centre[cell][a] += own * share * parts[a].centre[c >> a & 1];
			});
		}
	for (std::size_t cell = 0; cell < centre.size(); ++cell)
		centre[cell] = volume[cell] > 0 ? Vec<Dim>(centre[cell] / volume[cell]) : Vec<Dim>::Constant(0.5);
	return centre;
}

/// Along each axis, of the centres of the cells on a side the average by the shares of the domain.
template <int Dim> PointBasis<Dim> atCentres(const Patch<Dim>& patch, const PointBasis<Dim>& axes, const std::vector<Vec<Dim>>& centre)
{
	double share[Dim][2] = {}, moment[Dim][2] = {};
	forParts(patch, axes, [&](int c, int cell, const auto&, double part) {
		for (int a = 0; a < Dim; ++a) {
			share[a][c >> a & 1] += part;
			moment[a][c >> a & 1] += part * centre[cell][a];
		}
	});
	PointBasis<Dim> result = axes;
	for (int a = 0; a < Dim; ++a) {
		const AxisParts parts(axes[a], patch.span >> a & 1);
		const auto      at    = [&](int side) { return share[a][side] > 0 ? moment[a][side] / share[a][side] : 0.5; };
		auto&           value = result[a].value;
		value[0]              = parts.share[0] * (1 - at(0));
		value[2]              = parts.share[1] * at(1);
		value[1]              = 1 - value[0] - value[2];
	}
	return result;
}

/// Radius of the centre of the section of the matter in each cell: of parts with the volumes V at r the sum of V over
/// that of V / r.
template <int Dim> std::vector<double> sectionRadii(const PointCloud<Dim>& cloud, const CloudBasis<Dim>& basis)
{
	std::vector<double> volume(basis.cells.size(), 0), area(volume);
	for (const auto& patch : basis.patches)
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const int       p   = basis.order[i];
			const double    own = cloud.volume0[p] * cloud.volumeRatio(p);
			const RingParts ring(basis.axes[i][0], basis.hoop[i], cloud.halfSize[p][0], patch.span & 1, !basis.leafOf.empty());
			forParts(patch, basis.axes[i], [&](int c, int cell, const auto&, double share) {
				volume[cell] += own * share;
				area[cell] += own * share / ring.radius[c & 1];
			});
		}
	for (std::size_t cell = 0; cell < volume.size(); ++cell)
		volume[cell] /= area[cell];
	return volume;
}

} // namespace

template <int Dim> std::vector<AxisValues> hoopAtCentres(const PointCloud<Dim>& cloud, const CloudBasis<Dim>& basis)
{
	const auto              radius = sectionRadii(cloud, basis);
	std::vector<AxisValues> result(basis.axes.size());
	for (const auto& patch : basis.patches)
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			const RingParts ring(basis.axes[i][0], basis.hoop[i], cloud.halfSize[basis.order[i]][0], patch.span & 1, !basis.leafOf.empty());
			result[i].fill(0);
			forParts(patch, basis.axes[i], [&](int c, int cell, const auto&, double share) {
				const int side = c & 1;
				// Hat function of the upper node of the cell.
				const double upper = (radius[cell] - ring.face) / ring.size + 1 - side;
				result[i][side] += share * (1 - upper) / radius[cell];
				result[i][side + 1] += share * upper / radius[cell];
			});
		}
	return result;
}

template <int Dim> std::vector<PointBasis<Dim>> basisAtCentres(const PointCloud<Dim>& cloud, const CloudBasis<Dim>& basis)
{
	const auto                   centre = centresOfMatter(cloud, basis);
	std::vector<PointBasis<Dim>> result(basis.axes.size());
#pragma omp parallel for schedule(static)
	for (int k = 0; k < int(basis.patches.size()); ++k) {
		const auto& patch = basis.patches[k];
		for (int i = patch.first; i < patch.first + patch.count; ++i)
			result[i] = atCentres(patch, basis.axes[i], centre);
	}
	return result;
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template std::vector<PointBasis<Dim>> basisAtCentres(const PointCloud<Dim>&, const CloudBasis<Dim>&);                                                  \
	template std::vector<AxisValues>      hoopAtCentres(const PointCloud<Dim>&, const CloudBasis<Dim>&);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
