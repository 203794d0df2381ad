// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Checks that points and boxes of nodes go with the grid of an analysis.
#include "core/grid/basis.hpp"
#include "core/grid/boundary.hpp"
#include "core/grid/domain.hpp"
#include "engine/grid/MpmGrid.hpp"
#include "engine/points/MaterialPoints.hpp"

namespace yade {

// True if a point is on a grid without axis and period, and its domain not too large for it, as of nearly all.
template <int Dim> bool fitsPlainly(const gimpm::Vec<Dim>& position, const gimpm::Vec<Dim>& halfSize, const gimpm::Grid<Dim>& grid)
{
	return !grid.axisymmetric && !grid.isPeriodic() && ((position - grid.origin) / grid.cellSize).cwiseAbs().maxCoeff() < grid.indexLimit
	        && halfSize.maxCoeff() <= 0.5 * gimpm::largestCell(grid);
}

// std::invalid_argument names the body that does not.
template <int Dim> void requireFit(const MaterialPoint&, const gimpm::Grid<Dim>&, gimpm::Basis, gimpm::DomainRule);

// Nodes in a box, by the name of its class. std::invalid_argument if there is none.
template <int Dim> gimpm::ConstrainedBox<Dim> boxOfNodes(const string& name, const Vector3r& min, const Vector3r& max, const MpmGrid&, const gimpm::Grid<Dim>&);

} // namespace yade
