// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/grid/fit.hpp"
#include "engine/points/stretched.hpp"

namespace yade {

template <int Dim>
gimpm::ConstrainedBox<Dim> boxOfNodes(const string& name, const Vector3r& min, const Vector3r& max, const MpmGrid& grid, const gimpm::Grid<Dim>& lattice)
{
	const auto box         = gimpm::ConstrainedBox<Dim>::from(lattice, min.head<Dim>(), max.head<Dim>());
	const bool missesPlane = Dim == 2 && (min[2] > grid.origin[2] || max[2] < grid.origin[2]);
	if (!box.empty() && !missesPlane) return box;
	std::ostringstream text;
	text << name << " from min = (" << min.transpose() << ") to max = (" << max.transpose() << ") contains no grid node; nodes are at "
	     << grid.origin.transpose() << " plus multiples of " << (lattice.refinement ? "the smallest cell = " : "cellSize = ") << lattice.cellSize << ".";
	if (lattice.isPeriodic()) text << " Along a periodic axis they are from there to there plus MpmGrid.period = (" << grid.period.transpose() << ").";
	throw std::invalid_argument(text.str());
}

namespace {
	// True if a domain is too large by its deformation, as after mpm.assign; one that was too large from the
	// beginning is none of this grid.
	template <int Dim> bool hasOutgrown(const MaterialPoint& point, Real limit, gimpm::DomainRule rule)
	{
		const Vector3r grown = stretched<Dim>(point.shape->halfSize0, point.state->defGrad, rule) * (1 + 1e-9);
		return point.shape->halfSize0.head<Dim>().maxCoeff() <= limit && (point.shape->halfSize - grown).head<Dim>().maxCoeff() <= 0;
	}

	// Sides of a periodic grid are not where points end: those beyond would lie upon others.
	template <int Dim> void requireWithinPeriod(const MaterialPoint& point, const gimpm::Grid<Dim>& grid)
	{
		for (int a = 0; a < Dim; ++a) {
			const Real length = grid.period[a] * grid.cellSize, place = point.state->pos[a] - grid.origin[a];
			if (grid.period[a] == 0 || (place >= 0 && place <= length)) continue;
			std::ostringstream text;
			text << "Body #" << point.id << ": the material point at (" << point.state->pos.transpose()
			     << ") is outside of the period of the grid, along "
			     << "xyz"[a] << " from " << grid.origin[a] << " to " << grid.origin[a] + length
			     << " m (MpmGrid.origin and period); has a longer region been filled?";
			throw std::invalid_argument(text.str());
		}
	}

	template <int Dim> void requireOnGrid(const MaterialPoint& point, const gimpm::Grid<Dim>& grid, gimpm::Basis basis, gimpm::DomainRule rule)
	{
		const bool onGrid   = ((point.state->pos.head<Dim>() - grid.origin) / grid.cellSize).cwiseAbs().maxCoeff() < grid.indexLimit;
		const Real cellSize = gimpm::largestCell(grid);
		const Real largest = point.shape->halfSize.head<Dim>().maxCoeff(), limit = 0.5 * cellSize * (1 + 1e-9);
		const bool fits = basis != gimpm::Basis::gimp || largest <= limit || hasOutgrown<Dim>(point, limit, rule);
		if (onGrid && fits) return;
		std::ostringstream text; // costly: not before there is something to say
		text << "Body #" << point.id << ": ";
		if (!onGrid)
			text << "the material point at (" << point.state->pos.transpose() << ") is more than " << grid.indexLimit
			     << " cells from the grid's origin.";
		else
			text << "MpmPoint.halfSize = " << largest << " m is more than half a cell (cellSize = " << cellSize
			     << " m); was the point made for another grid?";
		throw std::invalid_argument(text.str());
	}

	// True if a point has its initial volume as a ring; where the displacements of others have been counted anew,
	// as near as a hoop strain is to the change of its radius.
	bool isRing(const MaterialPoint& point)
	{
		constexpr Real tolerance = 1e-6;
		const Real     half = point.shape->halfSize0[2], around = M_PI * point.state->refPos[0];
		if (std::abs(half - around) <= tolerance * around) return true;
		const Real now = half * point.state->defGrad(2, 2) / (M_PI * point.state->pos[0]);
		return point.state->defGrad != Matrix3r::Identity() && now > 0.5 && now < 2;
	}

	// Points around an axis, which stand for rings.
	template <int Dim> void requireRing(const MaterialPoint& point)
	{
		constexpr Real     tolerance = 1e-6;
		const Real         radius = point.state->pos[0], half = point.shape->halfSize[0], around = M_PI * point.state->refPos[0];
		std::ostringstream text;
		if (!(radius > 0))
			text << "the material point at (" << point.state->pos.transpose()
			     << ") is not at x > 0: with MpmGrid.axisymmetric x is the distance from the axis, and what is filled is one half of the section";
		else if (radius < half * (1 - tolerance))
			text << "the domain of the material point at (" << point.state->pos.transpose()
			     << ") crosses the axis of MpmGrid.axisymmetric: its halfSize along x, " << half
			     << " m, is more than its distance from the axis x = 0";
		else if (!isRing(point))
			text << "MpmPoint.halfSize0[2] = " << point.shape->halfSize0[2] << " m is not half the circumference, pi * refPos[0] = " << around
			     << " m: with MpmGrid.axisymmetric a point stands for a ring; was it made for another grid?";
		if (text.str().empty()) return;
		throw std::invalid_argument("Body #" + std::to_string(point.id) + ": " + text.str() + ".");
	}
}

template <int Dim> void requireFit(const MaterialPoint& point, const gimpm::Grid<Dim>& grid, gimpm::Basis basis, gimpm::DomainRule rule)
{
	requireOnGrid<Dim>(point, grid, basis, rule);
	requireWithinPeriod<Dim>(point, grid);
	if (grid.axisymmetric) requireRing<Dim>(point);
}

#define MPM_INSTANTIATE(Dim)                                                                                                                                   \
	template gimpm::ConstrainedBox<Dim> boxOfNodes(const string&, const Vector3r&, const Vector3r&, const MpmGrid&, const gimpm::Grid<Dim>&);              \
	template void                       requireFit(const MaterialPoint&, const gimpm::Grid<Dim>&, gimpm::Basis, gimpm::DomainRule);
MPM_INSTANTIATE(2)
MPM_INSTANTIATE(3)
#undef MPM_INSTANTIATE

} // namespace yade
