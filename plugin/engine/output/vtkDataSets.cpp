// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/output/vtkDataSets.hpp"
#include "core/grid/mixed_cells.hpp"
#include "core/stepping/step_system.hpp"
#include "engine/points/columns.hpp"
#include "engine/points/parallel.hpp"
#include "engine/points/stretched.hpp"
#include <algorithm>
#include <tuple>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

namespace yade {

namespace {
	// Corners of quadrilateral (the first four) and hexahedron in VTK's order: bit a set for the upper end along
	// axis a.
	constexpr int corners[] = { 0, 1, 3, 2, 4, 5, 7, 6 };

	constexpr int boxType(int dim) { return dim == 2 ? VTK_QUAD : VTK_HEXAHEDRON; }

	// About the axis y by a part of the full circle, from x to z.
	Matrix3r turned(Real part)
	{
		const Real angle = 2 * M_PI * part, c = std::cos(angle), s = std::sin(angle);
		return (Matrix3r() << c, 0, -s, 0, 1, 0, s, 0, c).finished();
	}

	// Cell type and number of corners belong together.
	class Cells {
	public:
		explicit Cells(int type) : type(type) { points->SetDataTypeToDouble(); }
		vtkIdType addPoint(const Vector3r& x) { return points->InsertNextPoint(x.data()); }
		void      reserve(size_t number, int corners)
		{
			points->Allocate(number * corners);
			cells->AllocateExact(number, number * corners);
		}
		template <size_t N> void addCell(const std::array<vtkIdType, N>& pointIds, int used = N) { cells->InsertNextCell(used, pointIds.data()); }

		VtkCells dataSet() const
		{
			const auto result = VtkCells::New();
			result->SetPoints(points);
			result->SetCells(type, cells);
			return result;
		}

	private:
		int                  type;
		vtkNew<vtkPoints>    points;
		vtkNew<vtkCellArray> cells;
	};

	// Room for a field, which the data set has from now on.
	template <class Array>
	decltype(std::declval<Array>().GetPointer(0)) addRoom(vtkUnstructuredGrid& cells, const string& name, int components, size_t number)
	{
		const auto field = vtkSmartPointer<Array>::New();
		field->SetName(name.c_str());
		field->SetNumberOfComponents(components);
		field->SetNumberOfTuples(number);
		cells.GetCellData()->AddArray(field);
		return field->GetPointer(0);
	}

	// One field: write(item, first of its components) for each item.
	template <class Array, class Items, class Write>
	void addField(vtkUnstructuredGrid& cells, const char* name, int components, const Items& items, Write write)
	{
		auto* value = addRoom<Array>(cells, name, components, items.size());
		for (const auto& item : items) {
			write(item, value);
			value += components;
		}
	}
	template <class Items, class Get> void addReals(vtkUnstructuredGrid& cells, const char* name, const Items& items, Get get)
	{
		addField<vtkDoubleArray>(cells, name, 1, items, [&](const auto& item, double* value) { *value = get(item); });
	}
	template <class Items, class Get> void addIntegers(vtkUnstructuredGrid& cells, const char* name, const Items& items, Get get)
	{
		addField<vtkIntArray>(cells, name, 1, items, [&](const auto& item, int* value) { *value = get(item); });
	}

	// Rotations to the centres of sectors of the circle about the axis y, from the plane x-y.
	vector<Matrix3r> turns(int sectors)
	{
		vector<Matrix3r> all;
		for (int s = 0; s < sectors; ++s)
			all.push_back(turned((s + 0.5) / sectors));
		return all;
	}

	// One row for each sector of each point.
	vector<Real> revolved(const vector<Real>& values, int width, const vector<Matrix3r>& turns)
	{
		using RowByRow = Eigen::Matrix<Real, 3, 3, Eigen::RowMajor>;
		vector<Real> all;
		all.reserve(values.size() * turns.size());
		for (const Real* row = values.data(); row < values.data() + values.size(); row += width)
			for (const Matrix3r& Q : turns) {
				const RowByRow tensor = width == 9 ? RowByRow(Q * Eigen::Map<const RowByRow>(row) * Q.transpose()) : RowByRow();
				const Vector3r vector = width == 3 ? Vector3r(Q * Eigen::Map<const Vector3r>(row)) : Vector3r();
				const Real*    from   = width == 9 ? tensor.data() : width == 3 ? vector.data() : row;
				all.insert(all.end(), from, from + width);
			}
		return all;
	}

	void addColumns(
	        vtkUnstructuredGrid& cells, const vector<const PointColumn*>& columns, const vector<MaterialPoint>& points, const Scene& scene,
	        const vector<Matrix3r>& turns)
	{
		const size_t         parts = std::max<size_t>(1, turns.size());
		vector<ColumnRows>   table;
		vector<vector<Real>> others(columns.size()); // rows that are not yet those of the data set
		vector<void*>        rooms;
		for (size_t c = 0; c < columns.size(); ++c) {
			const auto& [name, width, isInteger] = std::tie(columns[c]->name, columns[c]->width, columns[c]->isInteger);
			rooms.push_back(
			        isInteger ? static_cast<void*>(addRoom<vtkIntArray>(cells, name, width, parts * points.size()))
			                  : addRoom<vtkDoubleArray>(cells, name, width, parts * points.size()));
			if (isInteger || !turns.empty()) others[c].resize(points.size() * width);
			table.push_back({ columns[c], others[c].empty() ? static_cast<Real*>(rooms[c]) : others[c].data() });
		}
		fillRows(table, points, scene);
		for (size_t c = 0; c < columns.size(); ++c) {
			if (others[c].empty()) continue;
			const auto values = turns.empty() ? others[c] : revolved(others[c], columns[c]->width, turns);
			if (columns[c]->isInteger) std::copy(values.begin(), values.end(), static_cast<int*>(rooms[c]));
			else
				std::copy(values.begin(), values.end(), static_cast<double*>(rooms[c]));
		}
	}

	template <int Dim> bool isClamped(const MaterialPoint& point, const gimpm::Grid<Dim>& grid, gimpm::DomainRule rule)
	{
		const Vector3r size = stretched<Dim>(point.shape->halfSize0, point.state->defGrad, rule);
		return (size.template head<Dim>().array() > gimpm::largestHalf<Dim>(grid, point.state->pos.head<Dim>())).any();
	}

	// The field of those whose domain is cut off at half a cell.
	template <int Dim>
	void addClamped(
	        vtkUnstructuredGrid& cells, const vector<MaterialPoint>& points, const gimpm::Grid<Dim>& grid, std::optional<gimpm::DomainRule> rule,
	        int sectors)
	{
		const int parts = std::max(1, sectors);
		int*      first = addRoom<vtkIntArray>(cells, "clamped", 1, parts * points.size());
		inRanges(points.size(), [&](size_t begin, size_t end) {
			for (size_t p = begin; p < end; ++p)
				std::fill_n(first + parts * p, parts, rule && isClamped(points[p], grid, *rule));
		});
	}

	template <int Dim> void addNodes(Cells& cells, const vector<gimpm::Key>& nodes, const gimpm::Grid<Dim>& grid, Real z)
	{
		for (const gimpm::Key node : nodes) {
			Vector3r x(0, 0, z);
			x.head<Dim>() = grid.nodePosition(grid.index(node));
			cells.addPoint(x);
		}
	}

	// Nodes of all levels of a layer in one place are one.
	template <int Dim> gimpm::Key placeOf(gimpm::Key node)
	{
		using Lattice = gimpm::Grid<Dim>;
		return Lattice::key(Lattice::index(node), 0, Lattice::layer(node));
	}

	// A cell is named after its lowest node.
	template <int Dim> gimpm::Key cornerOf(gimpm::Key cell, int corner)
	{
		return placeOf<Dim>(cell + gimpm::Grid<Dim>::keyOffset(corner, gimpm::Grid<Dim>::level(cell)));
	}

	// The corners of the populated leaves, with some nodes in a refined grid, sorted. At the far sides of a
	// periodic grid these are not the nodes that stand for them.
	template <int Dim>
	vector<gimpm::Key> cornersOf(const gimpm::CloudBasis<Dim>& basis, const gimpm::Grid<Dim>& grid, const vector<gimpm::Key>& besides = {})
	{
		if (!grid.isPeriodic() && !grid.refinement) return basis.nodes;
		vector<gimpm::Key> nodes = besides;
		for (const gimpm::Key cell : basis.populatedLeaves())
			for (int c = 0; c < 1 << Dim; ++c)
				nodes.push_back(cornerOf<Dim>(cell, c));
		std::sort(nodes.begin(), nodes.end());
		nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
		return nodes;
	}
}

vector<const PointColumn*> fieldsOf(const vector<MaterialPoint>& points)
{
	const bool moves
	        = std::any_of(points.begin(), points.end(), [](const MaterialPoint& p) { return !p.state->vel.isZero(0) || !p.state->acceleration.isZero(0); });
	vector<const PointColumn*> fields;
	for (const PointColumn* column : columnsOf(points))
		if (column->is(PointColumn::inVtk) && (moves || !column->is(PointColumn::ofMotion))) fields.push_back(column);
	return fields;
}

VtkCells pointDomains(
        const vector<MaterialPoint>& points, const Scene& scene, const MpmGrid& grid, const vector<const PointColumn*>& fields,
        std::optional<gimpm::DomainRule> rule, bool withClamped, int sectors)
{
	const int dim = grid.dim, boxDim = sectors > 0 ? 3 : dim;
	Cells     domains(boxType(boxDim));
	domains.reserve(points.size() * std::max(1, sectors), 1 << boxDim);
	for (const MaterialPoint& point : points)
		for (int sector = 0; sector < std::max(1, sectors); ++sector) {
			std::array<vtkIdType, 8> box {};
			for (int c = 0; c < 1 << boxDim; ++c) {
				Vector3r x = point.state->pos;
				for (int a = 0; a < dim; ++a)
					x[a] += (corners[c] >> a & 1 ? 1 : -1) * point.shape->halfSize[a];
				if (sectors > 0) x = turned(Real(sector + (corners[c] >> 2 & 1)) / sectors) * Vector3r(x[0], x[1], 0);
				box[c] = domains.addPoint(x);
			}
			domains.addCell(box, 1 << boxDim);
		}
	const auto cells = domains.dataSet();
	addColumns(*cells, fields, points, scene, turns(sectors));
	if (withClamped) dim == 2 ? addClamped(*cells, points, grid.lattice<2>(), rule, sectors) : addClamped(*cells, points, grid.lattice<3>(), rule, sectors);
	return cells;
}

template <int Dim> VtkCells populatedCells(const gimpm::PointCloud<Dim>& cloud, const gimpm::Model<Dim>& model, Real z)
{
	const auto basis = gimpm::cloudBasis(cloud, model.grid, model.basis, model.boundary);
	const auto nodes = cornersOf(basis, model.grid);
	Cells      boxes(boxType(Dim));
	addNodes(boxes, nodes, model.grid, z);
	const auto& leaves = basis.populatedLeaves();
	for (const gimpm::Key cell : leaves) {
		std::array<vtkIdType, 1 << Dim> box;
		for (int c = 0; c < 1 << Dim; ++c)
			box[c] = gimpm::position(nodes, cornerOf<Dim>(cell, corners[c]));
		boxes.addCell(box);
	}
	const auto cells      = boxes.dataSet();
	const auto atBoundary = gimpm::boundaryCells(leaves, model.boundary, model.grid);
	addIntegers(*cells, "boundary", leaves, [&](gimpm::Key cell) { return gimpm::find(atBoundary, cell) >= 0; });
	const auto mixed = gimpm::mixedCells(basis, cloud.material);
	addIntegers(*cells, "mixed", mixed, [](char isMixed) { return isMixed; });
	return cells;
}

template <int Dim> VtkCells stabilisedFaces(const gimpm::PointCloud<Dim>& cloud, const gimpm::Model<Dim>& model, Real z)
{
	using Face = gimpm::GhostFace<Dim>;
	gimpm::StepReport            report;
	const gimpm::StepSystem<Dim> system(cloud, model, gimpm::Load<Dim>(), report);
	Cells                        surfaces(Dim == 2 ? VTK_LINE : VTK_QUAD);
	vector<gimpm::Key>           ofFaces;
	for (const Face& face : system.faces)
		for (int c = 0; c < Face::tangentialNodes; ++c)
			ofFaces.push_back(placeOf<Dim>(face.key(1, c)));
	const auto nodes = cornersOf(system.basis, model.grid, ofFaces);
	addNodes(surfaces, nodes, model.grid, z);
	for (const Face& face : system.faces) {
		std::array<vtkIdType, Face::tangentialNodes> surface;
		for (int c = 0; c < Face::tangentialNodes; ++c)
			surface[c] = gimpm::position(nodes, placeOf<Dim>(face.key(1, corners[c])));
		surfaces.addCell(surface);
	}
	const auto cells = surfaces.dataSet();
	addReals(*cells, "ghostStiffness", system.faces, [](const Face& face) { return face.stiffness; });
	return cells;
}

template VtkCells populatedCells(const gimpm::PointCloud<2>&, const gimpm::Model<2>&, Real);
template VtkCells populatedCells(const gimpm::PointCloud<3>&, const gimpm::Model<3>&, Real);
template VtkCells stabilisedFaces(const gimpm::PointCloud<2>&, const gimpm::Model<2>&, Real);
template VtkCells stabilisedFaces(const gimpm::PointCloud<3>&, const gimpm::Model<3>&, Real);

} // namespace yade
