// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/MpmGrid.hpp"

namespace yade {

Vector3i MpmGrid::periodInCells() const
{
	constexpr Real tolerance = 1e-9;
	Vector3i       cells     = Vector3i::Zero();
	for (int a = 0; a < 3; ++a) {
		if (period[a] == 0) continue;
		const Real         number = period[a] / cellSize, whole = std::round(number);
		std::ostringstream text;
		if (a >= dim) text << "there is nothing along z with dim=2 (plane strain in x-y)";
		else if (std::abs(number - whole) > tolerance * number)
			text << "along "
			     << "xyz"[a] << " it is " << number << " cells (cellSize = " << cellSize
			     << "), not a whole number of them: " << std::max<Real>(whole, gimpm::Grid<2>::smallestPeriod) * cellSize << " m would be";
		else if (whole < gimpm::Grid<2>::smallestPeriod)
			text << "along "
			     << "xyz"[a] << " it is " << whole << " cells, fewer than " << gimpm::Grid<2>::smallestPeriod
			     << ": the domain of a point reaches three nodes, which must not be the same";
		else if (whole > gimpm::Grid<3>::indexLimit)
			text << "along "
			     << "xyz"[a] << " it is " << whole << " cells, more than " << gimpm::Grid<3>::indexLimit;
		else {
			cells[a] = int(whole);
			continue;
		}
		std::ostringstream message;
		message << "MpmGrid.period = (" << period.transpose() << "): " << text.str() << ".";
		throw std::invalid_argument(message.str());
	}
	return cells;
}

void MpmGrid::requireAxis() const
{
	if (!axisymmetric) return;
	std::ostringstream text;
	const Real         node = origin[0] / cellSize;
	if (dim == 3) text << "it is for dim=2, where the plane x-y is the section of the body";
	else if (std::abs(node - std::round(node)) > 1e-9)
		text << "the axis x = 0 must be a grid line, but origin[0] = " << origin[0] << " is " << node << " cells away from it (cellSize = " << cellSize
		     << ")";
	else if (period[0] != 0)
		text << "the radius x cannot repeat itself (period[0] = " << period[0] << ")";
	if (text.str().empty()) return;
	throw std::invalid_argument("MpmGrid.axisymmetric = True: " + text.str() + ".");
}

template <int Dim> gimpm::Grid<Dim> MpmGrid::lattice() const
{
	requireAxis();
	return { cellSize, origin.head<Dim>(), periodInCells().head<Dim>(), axisymmetric };
}
template gimpm::Grid<2> MpmGrid::lattice() const;
template gimpm::Grid<3> MpmGrid::lattice() const;

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmGrid)
static const yade::PluginClasses<yade::MpmGrid> registeredMpmGrid(__FILE__);
