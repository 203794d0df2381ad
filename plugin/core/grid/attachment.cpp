// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/grid/attachment.hpp"
#include "core/grid/cells_around.hpp"
#include <limits>

namespace gimpm {
namespace {

/// Distance of a position in cell coordinates from a cell along each axis, 0 inside [cells].
template <int Dim> Vec<Dim> outside(const Vec<Dim>& xi, const Index<Dim>& cell)
{
	const auto local = (xi - cell.template cast<double>()).array();
	return (-local).max(local - 1).max(0.);
}

/// The populated cell of a level that is nearest to a position in coordinates of such cells, as the crow flies: by the
/// worst axis alone the cells beside the nearest one would be as near as that, and the order of cells or round-off
/// would choose. Of equally near ones the first. With the layer of its nodes.
template <int Dim>
std::optional<std::pair<Index<Dim>, int>> nearestCell(const Vec<Dim>& xi, const std::vector<Key>& populated, const Grid<Dim>& grid, int level, int layer)
{
	std::optional<std::pair<Index<Dim>, int>> nearest;
	double                                    least = std::numeric_limits<double>::infinity();
	const Index<Dim>                          own   = xi.array().floor().template cast<int>();
	for (int i = 0; i < cellsAround<Dim>; ++i) {
		const Index<Dim> cell = own + offsetAround<Dim>(i);
		const Vec<Dim>   away = outside<Dim>(xi, cell);
		if (away.maxCoeff() > attachmentTolerance || away.squaredNorm() >= least) continue;
		Key key = Grid<Dim>::key(grid.first(cell * (1 << level)), level, layer);
		if (grid.parting) key = grid.parting->cellFor(key);
		if (find(populated, key) >= 0) nearest = { cell, Grid<Dim>::layer(key) }, least = away.squaredNorm();
	}
	return nearest;
}

} // namespace

template <int Dim> std::optional<Attachment<Dim>> attach(const Vec<Dim>& location, const CloudBasis<Dim>& basis, const Grid<Dim>& grid, int layer)
{
	std::optional<Attachment<Dim>> attached;
	Vec<Dim>                       local = Vec<Dim>::Zero();
	double                         least = std::numeric_limits<double>::infinity();
	if (layer == layerOfPosition) layer = grid.parting ? grid.parting->layerAt(location) : 0;
	for (int level = grid.refinement ? grid.refinement->largest() : 0; level >= 0; --level) {
		const Vec<Dim> xi = (location - grid.origin) / grid.size(level);
		if (!(xi.array().abs() < Grid<Dim>::indexLimit >> level).all()) return std::nullopt;
		const auto cell = nearestCell<Dim>(xi, basis.populatedLeaves(), grid, level, layer);
		if (!cell) continue;
		const double away = outside<Dim>(xi, cell->first).norm() * (1 << level);
		if (away >= least) continue;
		least    = away;
		local    = xi - cell->first.template cast<double>();
		attached = Attachment<Dim> { cell->first, level, cell->second, {}, {} };
	}
	for (int n = 0; attached && n < attached->nodes; ++n)
		attached->node[n]
		        = position(basis.nodes, Grid<Dim>::key(grid.first(attached->index(n) * (1 << attached->level)), attached->level, attached->layer));
	if (attached) attached->weigh(local);
	return attached;
}

template std::optional<Attachment<2>> attach(const Vec<2>&, const CloudBasis<2>&, const Grid<2>&, int);
template std::optional<Attachment<3>> attach(const Vec<3>&, const CloudBasis<3>&, const Grid<3>&, int);

} // namespace gimpm
