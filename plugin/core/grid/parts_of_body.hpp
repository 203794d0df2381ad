// SPDX-License-Identifier: GPL-2.0-or-later
// Parts of a body of points, and the surface of one.
#pragma once
#include "core/grid/surface.hpp"
#include <set>

namespace gimpm {

/// The domain of a point, a box along the axes.
template <int Dim> struct DomainBox {
	Vec<Dim> low, high; ///< [m]
};

template <int Dim> DomainBox<Dim> domainBox(const Vec<Dim>& centre, const Vec<Dim>& halfSize) { return { centre - halfSize, centre + halfSize }; }

/// Calls f(index) for all indices from the first to the last one along each axis.
template <int Dim, class F> void forIndicesUpTo(const Index<Dim>& first, const Index<Dim>& last, F&& f)
{
	Index<Dim> at = first;
	for (int a = 0; a < Dim;) {
		f(at);
		for (a = 0; a < Dim && ++at[a] > last[a]; ++a)
			at[a] = first[a];
	}
}

/// Calls f(cell) for the cells that a box reaches into.
template <int Dim, class F> void forCellsOf(const DomainBox<Dim>& box, const Vec<Dim>& origin, double size, F&& f)
{
	constexpr double slack = 1e-6; // reach that counts as none [cells]
	Index<Dim>       first, last;
	for (int a = 0; a < Dim; ++a)
		first[a] = int(std::floor((box.low[a] - origin[a]) / size + slack)), last[a] = int(std::floor((box.high[a] - origin[a]) / size - slack));
	forIndicesUpTo<Dim>(first, last, f);
}

/// Numbers of the parts that boxes belong to, counted from 0 in the order of their first boxes. Boxes that reach into
/// the same cell or into neighbouring cells share nodes, and are of one part.
template <int Dim> std::vector<int> partsBySharedNodes(const std::vector<DomainBox<Dim>>&, const Grid<Dim>&);

/// The same, where boxes are of one part if their distance along each axis is at most `gap`. No box may be longer than
/// a cell.
template <int Dim> std::vector<int> partsByTouch(const std::vector<DomainBox<Dim>>&, double gap, double cellSize);

/// Pairs of owners, the lower number first, of which boxes share nodes: those of partsBySharedNodes().
template <int Dim>
std::set<std::pair<int, int>> sharingNodes(const std::vector<DomainBox<Dim>>&, const std::vector<int>& owners, const Vec<Dim>& origin, double cellSize);

/// Number of the box that is nearest to each position.
template <int Dim> std::vector<int> nearestBoxes(const std::vector<DomainBox<Dim>>&, const std::vector<Vec<Dim>>& positions, double cellSize);

/// Surface of a union of boxes, made of simplices of a lattice: where half of a cube of two spacings around a position
/// is covered. Faces along the axes are exact; edges are rounded by half a spacing.
template <int Dim> Surface<Dim> outline(const std::vector<DomainBox<Dim>>&, const Vec<Dim>& origin, double spacing);

} // namespace gimpm
