// SPDX-License-Identifier: GPL-2.0-or-later
// The nodes that a contact point presses on, and with which shares.
#pragma once
#include "core/grid/attachment.hpp"

namespace gimpm {

/// Functions that are one in sum and reproduce the contact point, so that forces on it keep resultant and moment: those
/// of the cell that it is in, or wider ones. The linear functions of a cell press on a single node where the contact
/// point is at one, and half a cell to either side of it between two nodes, where soil so gives way less. The quadratic
/// B-splines of the grid are means of the linear ones over a cell around the contact point, and spread a force alike
/// wherever it is.
template <int Dim> struct ForceDistribution {
	static constexpr int most = Dim == 2 ? 9 : 27;

	int                          nodes = 0;
	std::array<int, most>        node {};   ///< numbers
	std::array<double, most>     weight {}; ///< values of the functions [-]
	std::array<Index<Dim>, most> at {};     ///< coordinates of the nodes, as in the attachment

	ForceDistribution() = default;

	/// The functions of the cell.
	explicit ForceDistribution(const Attachment<Dim>& attachment) : nodes(attachment.nodes)
	{
		at.fill(Index<Dim>::Zero());
		for (int n = 0; n < nodes; ++n)
			node[n] = attachment.node[n], weight[n] = attachment.weight[n], at[n] = attachment.index(n);
	}

	/// `shares` of the splines along each axis, from 0 to 1, where the soil goes on; along others those of the
	/// cell. `mirrors`: axes along which the lower (-1) or upper (1) face of its cell is a plane of symmetry, where
	/// nodes beyond are images of those before.
	ForceDistribution(
	        const Attachment<Dim>& attachment, const Vec<Dim>& shares, const CloudBasis<Dim>&, const Grid<Dim>&, int layer,
	        const Index<Dim>& mirrors = Index<Dim>::Zero());

	const Index<Dim>& index(int n) const { return at[n]; }

	Vec<Dim> displacement(const Eigen::VectorXd& d) const
	{
		Vec<Dim> u = Vec<Dim>::Zero();
		for (int n = 0; n < nodes; ++n)
			u += weight[n] * d.template segment<Dim>(Dim * node[n]);
		return u;
	}
};

/// Along an axis, on which side of its cell a contact point is: 1 or -1, and 0 in the centre, where splines and linear
/// functions are the same.
template <int Dim> int sideInCell(const Attachment<Dim>&, int axis);

} // namespace gimpm
