// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/grid/MpmGrid.hpp"
#include "engine/points/buffers.hpp"
#include "yade_api/registration.hpp"

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

void MpmGrid::requireLevels(const string& name, int halvings) const
{
	if (dim == 2 || halvings <= gimpm::Grid<3>::mostLevel) return;
	throw std::invalid_argument(
	        name + ".halvings = " + std::to_string(halvings) + " is not admitted with dim=3: expected 1 to " + std::to_string(gimpm::Grid<3>::mostLevel)
	        + ". Make cellSize smaller instead.");
}

void MpmGrid::requireAdmissible() const
{
	Exposed::requireAdmissible();
	for (size_t r = 0; r < refinements.size(); ++r) {
		if (!refinements[r]) throw std::invalid_argument("MpmGrid.refinements[" + std::to_string(r) + "] = None: expected an MpmRefinement.");
		refinements[r]->requireAdmissible();
		requireLevels("MpmGrid.refinements[" + std::to_string(r) + "]", refinements[r]->halvings);
	}
	for (size_t b = 0; b < bodies.size(); ++b) {
		if (!bodies[b]) throw std::invalid_argument("MpmGrid.bodies[" + std::to_string(b) + "] = None: expected an MpmBody.");
		bodies[b]->requireAdmissible();
		if (bodyNamed(bodies[b]->name) != int(b)) throw std::invalid_argument("MpmGrid.bodies: two of them are called '" + bodies[b]->name + "'.");
	}
	for (size_t a = 0; a < adaptation.size(); ++a) {
		const string name = "MpmGrid.adaptation[" + std::to_string(a) + "]";
		if (!adaptation[a]) throw std::invalid_argument(name + " = None: expected an MpmAdaptation.");
		adaptation[a]->requireAdmissible();
		requireLevels(name, adaptation[a]->halvings);
	}
	if (hasEqualCells() || period.isZero(0)) return;
	std::ostringstream text;
	text << "MpmGrid." << (refinements.empty() ? "adaptation" : "refinements") << ": a grid with period = (" << period.transpose()
	     << ") cannot have cells of several sizes; leave one of the two out.";
	throw std::invalid_argument(text.str());
}

Real MpmGrid::smallestCell() const
{
	int        most = 0;
	const auto look = [&most](const auto& list) {
		for (const auto& one : list)
			most = std::max(most, one->halvings);
	};
	look(refinements);
	look(adaptation);
	return cellSize / (1 << most);
}

int MpmGrid::bodyNamed(const string& name) const
{
	for (size_t b = 0; b < bodies.size(); ++b)
		if (bodies[b]->name == name) return int(b);
	return -1;
}

const string& MpmGrid::nameOfWhole(int body) const { return bodies[body]->partOf.empty() ? bodies[body]->name : bodies[body]->partOf; }

template <int Dim> void MpmGrid::refine(gimpm::Grid<Dim>& grid) const
{
	vector<gimpm::RefinedBox<Dim>> boxes;
	for (const auto* list : { &refinements, &adapted })
		for (const auto& box : *list)
			boxes.push_back({ box->min.template head<Dim>(), box->max.template head<Dim>(), box->halvings });
	grid.refinement = std::make_shared<gimpm::Refinement<Dim>>(boxes, grid);
	grid.cellSize /= 1 << grid.refinement->largest();
}

template <int Dim> gimpm::Grid<Dim> MpmGrid::lattice() const
{
	requireAxis();
	gimpm::Grid<Dim> grid { cellSize, origin.head<Dim>(), periodInCells().head<Dim>(), axisymmetric, nullptr };
	if (!refinements.empty() || !adapted.empty()) refine(grid);
	grid.isAdaptive = !adaptation.empty();
	return grid;
}
template gimpm::Grid<2> MpmGrid::lattice() const;
template gimpm::Grid<3> MpmGrid::lattice() const;

namespace {
	template <int Dim> vector<Real> cellSizes(const gimpm::Grid<Dim>& grid, const Column<Real>& positions)
	{
		vector<Real> sizes(positions.size() / 3);
		for (size_t i = 0; i < sizes.size(); ++i)
			sizes[i] = 2 * gimpm::largestHalf<Dim>(grid, Eigen::Map<const Vector3r>(positions.data() + 3 * i).head<Dim>());
		return sizes;
	}
}

py::object cellSizesForPython(const MpmGrid& grid, const py::object& positions)
{
	grid.requireAdmissible();
	const Column<Real> places(positions, "positions");
	const auto         sizes = grid.dim == 2 ? cellSizes(grid.lattice<2>(), places) : cellSizes(grid.lattice<3>(), places);
	return py::object(py::handle<>(PyByteArray_FromStringAndSize(reinterpret_cast<const char*>(sizes.data()), sizes.size() * sizeof(Real))));
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmGrid)
static const yade::PluginClasses<yade::MpmGrid> registeredMpmGrid(__FILE__);
