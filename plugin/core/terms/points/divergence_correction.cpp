// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/points/divergence_correction.hpp"
#include "core/terms/parts_in_cells.hpp"

namespace gimpm {
namespace {

/// The displacements of the nodes of a cell of a patch's window, x fastest; not all are there beyond a wall.
template <int Dim> struct CellCorners {
	Vec<Dim> u[1 << Dim];
	bool     isWhole = true;

	CellCorners(const Patch<Dim>& patch, int cell, const Eigen::VectorXd& d)
	{
		for (int n = 0; n < 1 << Dim; ++n) {
			int node = 0;
			for (int a = Dim - 1; a >= 0; --a)
				node = node * patch.nodesAlong(a) + (cell >> a & 1) + (n >> a & 1);
			if (patch.node[node] < 0) isWhole = false;
			else
				u[n] = d.template segment<Dim>(Dim * patch.node[node]);
		}
	}

	/// Mixed difference of a component along axes a and b, at a position along the third.
	double mixed(int component, int a, int b, const Vec<Dim>& position) const
	{
		double sum = 0;
		for (int n = 0; n < 1 << Dim; ++n) {
			double weight = (n >> a ^ n >> b) & 1 ? -1 : 1;
			for (int c = 0; c < Dim; ++c)
				if (c != a && c != b) weight *= n >> c & 1 ? position[c] : 1 - position[c];
			sum += weight * u[n][component];
		}
		return sum;
	}
};

/// A part of a domain in a cell: of its centre from that of the cell, and half lengths, over the size of the cell.
template <int Dim> struct PartInCell {
	Vec<Dim> away, half;

	/// (x^2 - 1/4) / 2 on average over the part.
	double square(int a) const { return (away[a] * away[a] + half[a] * half[a] / 3 - 0.25) / 2; }
};

/// In cells of the size 1. What the dilation has by the product of two coordinates is shared by both.
template <int Dim> DivergenceCorrection<Dim> evenIn(const CellCorners<Dim>& corners, const PartInCell<Dim>& part)
{
	DivergenceCorrection<Dim> even;
	for (int b = 0; b < Dim; ++b) {
		double gradient = 0; // gradient of the dilation along b
		for (int a = 0; a < Dim; ++a)
			if (a != b) gradient += corners.mixed(a, a, b, Vec<Dim>::Constant(0.5) + part.away / 2);
		even.shift[b]  = -gradient * part.square(b);
		even.growth[b] = -gradient * part.away[b];
	}
	return even;
}

/// In a ring whose cell begins at the radius `inner`. With u_x = alpha + beta r the dilation is 2 beta + alpha / r +
/// du_y / dy. What differs with the height goes into the shift along the axis; of the rest, at half the height, r times
/// the radial shift is the integral over r dr, which vanishes at both faces as the mean over the ring is taken off.
DivergenceCorrection<2> evenInRing(const CellCorners<2>& corners, const PartInCell<2>& part, double inner)
{
	DivergenceCorrection<2> even;
	const auto&             u      = corners.u;
	const double            middle = inner + 0.5, x = part.away[0], r = middle + x;
	const double            growing = corners.mixed(0, 0, 1, Vec<2>::Zero()), along = 2 * growing + (u[2][0] - u[0][0] - growing * inner) / r;
	even.shift[1]    = -along * part.square(1);
	even.growth[1]   = -along * part.away[1];
	const double low = (u[0][0] + u[2][0]) / 2, high = (u[1][0] + u[3][0]) / 2, alpha = low - (high - low) * inner;
	const double across = corners.mixed(1, 1, 0, Vec<2>::Zero()), mean = 1 / (12 * middle); // mean of x, by volume
	const double square = part.square(0), cube = x * (x * x + part.half[0] * part.half[0]) / 3 + 1. / 24;
	even.shift[0]  = -(across * ((middle - mean) * square + cube - mean * middle * (x + 0.5)) - alpha * square / middle) / r;
	even.hoop      = even.shift[0] / r;
	even.growth[0] = -alpha * (1 / r - 1 / middle) - across * (x - mean) - even.hoop;
	return even;
}

/// In a cell of point i of the basis; `halfSize`: along x, where it `isInTwo` cells and this `isUpper` or not.
template <int Dim>
DivergenceCorrection<Dim> evenAround(
        const CloudBasis<Dim>& basis, int i, const CellCorners<Dim>& corners, const PartInCell<Dim>& part, double halfSize, bool isInTwo, bool isUpper)
{
	if constexpr (Dim == 2)
		if (basis.isAxisymmetric()) {
			const RingParts ring(basis.axes[i][0], basis.hoop[i], halfSize, isInTwo, !basis.leafOf.empty());
			return evenInRing(corners, part, std::max(0., ring.face / ring.size - !isUpper));
		}
	return evenIn(corners, part);
}

/// det(I + gradient at the centres).
template <int Dim> double ratioOf(const Patch<Dim>& patch, const StepPoints<Dim>& points, int i, const Eigen::VectorXd& d)
{
	Mat<Dim>  F     = Mat<Dim>::Identity();
	double    hoop  = 1;
	const int count = patch.nodesAlong(0) * patch.nodesAlong(1) * (Dim == 3 ? patch.nodesAlong(Dim - 1) : 1);
	for (int n = 0; n < count; ++n) {
		if (patch.node[n] < 0) continue;
		int at[Dim];
		for (int a = 0, rest = n; a < Dim; rest /= patch.nodesAlong(a), ++a)
			at[a] = rest % patch.nodesAlong(a);
		const Vec<Dim> u = d.template segment<Dim>(Dim * patch.node[n]);
		for (int j = 0; j < Dim; ++j) {
			double gradient = 1;
			for (int a = 0; a < Dim; ++a)
				gradient *= (a == j ? points.centres[i][a].gradient : points.centres[i][a].value)[at[a]];
			F.col(j) += gradient * u;
		}
		if (!points.hoopCentres.empty()) hoop += points.hoopCentres[i][at[0]] * points.centres[i][1].value[at[1]] * u[0];
	}
	return F.determinant() * hoop;
}

} // namespace

template <int Dim>
std::vector<DivergenceCorrection<Dim>> divergenceCorrections(
        const PointCloud<Dim>& cloud, const CloudBasis<Dim>& basis, const StepPoints<Dim>& points, const Grid<Dim>& grid, const Eigen::VectorXd& d)
{
	std::vector<DivergenceCorrection<Dim>> result(cloud.size());
#pragma omp parallel for schedule(static)
	for (int k = 0; k < int(basis.patches.size()); ++k) {
		const auto&  patch = basis.patches[k];
		const double h     = grid.size(Grid<Dim>::level(patch.cell));
		for (int i = patch.first; i < patch.first + patch.count; ++i) {
			DivergenceCorrection<Dim> sum;
			const Vec<Dim>            half = (cloud.halfSize[basis.order[i]] / h).cwiseMin(0.5);
			forParts(patch, basis.axes[i], [&](int c, int, const auto& parts, double share) {
				const CellCorners<Dim> corners(patch, c, d);
				if (!corners.isWhole) return;
				PartInCell<Dim> part;
				for (int a = 0; a < Dim; ++a)
					part.away[a] = parts[a].centre[c >> a & 1] - 0.5, part.half[a] = half[a] * parts[a].share[c >> a & 1];
				const auto even = evenAround(basis, i, corners, part, half[0] * h, patch.span & 1, c & 1);
				sum.shift += share * even.shift, sum.growth += share / h * even.growth, sum.hoop += share / h * even.hoop;
			});
			sum.ratio              = ratioOf(patch, points, i, d);
			result[basis.order[i]] = sum;
		}
	}
	return result;
}

#define GIMPM_INSTANTIATE(Dim)                                                                                                                                 \
	template std::vector<DivergenceCorrection<Dim>> divergenceCorrections(                                                                                 \
	        const PointCloud<Dim>&, const CloudBasis<Dim>&, const StepPoints<Dim>&, const Grid<Dim>&, const Eigen::VectorXd&);
GIMPM_INSTANTIATE(2)
GIMPM_INSTANTIATE(3)
#undef GIMPM_INSTANTIATE

} // namespace gimpm
