// SPDX-License-Identifier: GPL-2.0-or-later
// A position on the body that moves with the nodes of the grid, as the vertex of a loaded surface does.
#pragma once
#include "core/grid/cloud_basis.hpp"
#include <optional>

namespace gimpm {

/// The linear functions of one populated cell, in a refined grid of a leaf, at a position in it or close to it. Unlike
/// a material point a position is no domain: its functions are not averaged. They are one in sum and reproduce the
/// position, so that forces on it keep resultant and moment.
template <int Dim> struct Attachment {
	static constexpr int nodes = 1 << Dim;

	Index<Dim>                cell  = Index<Dim>::Zero(); ///< cell, numbered as if the grid were not periodic, in cells of its level
	int                       level = 0, layer = 0;
	std::array<int, nodes>    node;   ///< numbers, x fastest
	std::array<double, nodes> weight; ///< values of the functions [-]

	/// The functions at a position, from the lowest node on [cells of its level].
	void weigh(const Vec<Dim>& local)
	{
		for (int n = 0; n < nodes; ++n) {
			weight[n] = 1;
			for (int a = 0; a < Dim; ++a)
				weight[n] *= n >> a & 1 ? local[a] : 1 - local[a];
		}
	}

	/// Key of the leaf.
	Key leaf(const Grid<Dim>& grid) const { return Grid<Dim>::key(grid.first(cell * (1 << level)), level, layer); }

	/// Integer coordinates of a node, as if the grid were not periodic, in cells of its level.
	Index<Dim> index(int n) const
	{
		Index<Dim> i = cell;
		for (int a = 0; a < Dim; ++a)
			i[a] += n >> a & 1;
		return i;
	}

	/// Position from the lowest node on [smallest cells].
	Vec<Dim> inCell() const
	{
		Vec<Dim> local = Vec<Dim>::Zero();
		for (int n = 0; n < nodes; ++n)
			for (int a = 0; a < Dim; ++a)
				if (n >> a & 1) local[a] += weight[n] * (1 << level);
		return local;
	}

	double value(const Eigen::VectorXd& scalars) const
	{
		double sum = 0;
		for (int n = 0; n < nodes; ++n)
			sum += weight[n] * scalars[node[n]];
		return sum;
	}
	Vec<Dim> displacement(const Eigen::VectorXd& d) const
	{
		Vec<Dim> u = Vec<Dim>::Zero();
		for (int n = 0; n < nodes; ++n)
			u += weight[n] * d.template segment<Dim>(Dim * node[n]);
		return u;
	}
};

/// A position may be outside of the populated cells by this fraction of a cell, as surfaces do not follow the domains
/// of the points to the last digit; the functions of the nearest populated cell are then continued.
constexpr double attachmentTolerance = 0.25;

/// The layer that points have at a position: that of its side, where a line parts the body.
constexpr int layerOfPosition = -1;

/// To the body in a layer. None where no populated cell is near.
template <int Dim> std::optional<Attachment<Dim>> attach(const Vec<Dim>& position, const CloudBasis<Dim>&, const Grid<Dim>&, int layer = layerOfPosition);

} // namespace gimpm
