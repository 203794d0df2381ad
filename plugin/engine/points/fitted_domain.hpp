// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Domains of points that are split or merged between two steps, and how many of them a cell has.
#include "core/grid/refinement.hpp"
#include "engine/points/MaterialPoints.hpp"
#include "engine/points/stretched.hpp"

namespace yade {

// Half lengths of the domain as a step would leave them without a limit. A ring ends at the axis.
template <int Dim> Vector3r grownDomain(const MaterialPoint& point, const gimpm::Grid<Dim>& grid, gimpm::DomainRule rule)
{
	Vector3r size = stretched<Dim>(point.shape->halfSize0, point.state->defGrad, rule);
	if (grid.axisymmetric) size[0] = std::min(size[0], point.state->pos[0]);
	return size;
}

// Gives the point the domain that a step would give it: no larger than its cell.
template <int Dim> void fitDomain(const MaterialPoint& point, const gimpm::Grid<Dim>& grid, gimpm::DomainRule rule)
{
	const Vector3r size       = grownDomain(point, grid, rule);
	const Real     limit      = gimpm::largestHalf<Dim>(grid, point.state->pos.template head<Dim>());
	Vector3r&      half       = PointWriter().shape(point).halfSize;
	half.template head<Dim>() = size.template head<Dim>().cwiseMin(limit);
	if (grid.axisymmetric) half[2] = size[2];
}

// Section of the initial domain: its area in the plane, in space its volume.
template <int Dim> Real initialSection(const Vector3r& halfSize0) { return (2 * halfSize0.template head<Dim>()).prod(); }

// True if a cell of a size has two points or more with such a section along each axis.
template <int Dim> bool holdsTwo(Real size, Real section)
{
	constexpr Real margin = 1.01; // as of round-off in a cell that has two
	return section <= gimpm::Vec<Dim>::Constant(margin * size / 2).prod();
}

} // namespace yade
