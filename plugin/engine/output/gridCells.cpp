// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/output/gridCells.hpp"
#include "engine/analysis/empty_model.hpp"
#include "engine/analysis/exchange.hpp"
#include "engine/parallel/distribution.hpp"
#include "engine/points/parallel.hpp"
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

namespace yade {

namespace {
	template <int Dim> VtkCells cells(const string& kind, const Scene& scene, const Analysis& solver)
	{
		const ValueLock lock;
		if (isDivided(solver))
			throw std::invalid_argument(
			        "the cells of '" + kind + "' follow from all points, and with MpmImplicitEngine.distributed no process has them.");
		solver.requireConditions();
		auto       model = emptyModel<Dim>(solver, conditionsOf<Dim>(solver));
		const auto cloud = gather(materialPoints(scene, solver.mask), model);
		const Real z     = solver.grid->origin[2];
		return kind == "grid" ? populatedCells(cloud, model, z) : stabilisedFaces(cloud, model, z);
	}

	py::object bytes(const vector<Real>& values)
	{
		const char* begin = reinterpret_cast<const char*>(values.data());
		return py::object(py::handle<>(PyByteArray_FromStringAndSize(begin, values.size() * sizeof(Real))));
	}

	vtkSmartPointer<vtkDataArray> arrayOf(const Picture::Field& field)
	{
		vtkSmartPointer<vtkDataArray> array;
		if (field.isWhole) array = vtkSmartPointer<vtkIntArray>::New();
		else
			array = vtkSmartPointer<vtkDoubleArray>::New();
		array->SetName(field.name.c_str());
		array->SetNumberOfComponents(field.width);
		for (size_t i = 0; i < field.values.size(); i += field.width)
			array->InsertNextTuple(&field.values[i]);
		return array;
	}

	// Cells of one to four corners.
	VtkCells toVtk(const Picture& picture)
	{
		constexpr int        kinds[] = { VTK_EMPTY_CELL, VTK_VERTEX, VTK_LINE, VTK_TRIANGLE, VTK_QUAD };
		vtkNew<vtkPoints>    points;
		vtkNew<vtkCellArray> cells;
		vector<int>          types;
		points->SetDataTypeToDouble();
		for (const Vector3r& x : picture.corners)
			points->InsertNextPoint(x.data());
		for (const vector<int>& cell : picture.cells) {
			types.push_back(kinds[cell.size()]);
			cells->InsertNextCell(int(cell.size()));
			for (const int corner : cell)
				cells->InsertCellPoint(corner);
		}
		const auto result = VtkCells::New();
		result->SetPoints(points);
		result->SetCells(types.data(), cells);
		for (const Picture::Field& field : picture.fields)
			result->GetCellData()->AddArray(arrayOf(field));
		return result;
	}

	VtkCells pictureOf(const string& kind, const Analysis& solver)
	{
		Picture         picture;
		const ValueLock lock;
		for (const Listed& listed : solver.conditions())
			if (listed.condition->picture() && kind == listed.condition->picture()) listed.condition->draw(picture, solver, listed);
		picture.complete();
		return toVtk(picture);
	}
}

bool isOfConditions(const string& kind) { return kind != "points" && kind != "grid" && kind != "ghostFaces"; }

VtkCells gridCells(const string& kind, const Scene& scene, const Analysis& solver)
{
	if (isOfConditions(kind)) return pictureOf(kind, solver);
	return solver.grid->dim == 2 ? cells<2>(kind, scene, solver) : cells<3>(kind, scene, solver);
}

py::list touchableBodiesForPython(const Analysis& solver)
{
	py::list ids;
	for (const Listed& listed : solver.conditions())
		for (const auto& body : listed.condition->rigidBodies(*solver.ownScene()))
			ids.append(body->id);
	return ids;
}

py::dict gridCellsForPython(const string& kind, const Analysis& solver)
{
	solver.requireAttributes();
	requireThreadsOfThisProcess(omp_get_max_threads());
	const VtkCells    grid   = gridCells(kind, *solver.ownScene(), solver);
	vtkDataArray*     values = grid->GetCellData()->GetArray(0); // none where there is nothing
	const int         width  = values ? values->GetNumberOfComponents() : 0;
	vector<Real>      corners, middles, field;
	vtkNew<vtkIdList> nodes;
	for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
		grid->GetCellPoints(cell, nodes);
		Vector3r middle = Vector3r::Zero();
		for (vtkIdType n = 0; n < nodes->GetNumberOfIds(); ++n) {
			const Vector3r x(grid->GetPoint(nodes->GetId(n)));
			corners.insert(corners.end(), x.data(), x.data() + 3);
			middle += x / Real(nodes->GetNumberOfIds());
		}
		middles.insert(middles.end(), middle.data(), middle.data() + 3);
		for (int i = 0; i < width; ++i)
			field.push_back(values->GetComponent(cell, i));
	}
	py::dict result;
	result["corners"] = bytes(corners);
	result["middles"] = bytes(middles);
	result["field"]   = bytes(field);
	result["count"]   = grid->GetNumberOfCells();
	return result;
}

} // namespace yade
