// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/output/loadedSurfaces.hpp"
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
	Vector3r tractionOn(const vector<int>& piece, const MpmTraction& load, Real factor)
	{
		const MpmSurface& surface = *load.surface;
		const Vector3r    now     = surface.normal(piece, surface.vertices);
		const Vector3r    first   = surface.initialVertices.empty() ? now : surface.normal(piece, surface.initialVertices);
		return factor * (first.norm() / now.norm() * load.traction - load.pressure * now.normalized());
	}
}

VtkCells loadedSurfaces(const Loads& given, Real time, int dim)
{
	vtkNew<vtkPoints>      points;
	vtkNew<vtkCellArray>   cells;
	vtkNew<vtkIntArray>    number;
	vtkNew<vtkDoubleArray> traction;
	points->SetDataTypeToDouble();
	number->SetName("load");
	traction->SetName("traction");
	traction->SetNumberOfComponents(3);
	for (size_t i = 0; i < given.loads.size(); ++i) {
		const MpmTraction& load   = *given.loads[i];
		const Real         factor = given.curveOf(load).valueAt(time);
		const vtkIdType    first  = points->GetNumberOfPoints();
		for (const Vector3r& vertex : load.surface->vertices)
			points->InsertNextPoint(vertex.data());
		for (const vector<int>& piece : load.surface->pieces) {
			cells->InsertNextCell(int(piece.size()));
			for (const int v : piece)
				cells->InsertCellPoint(first + v);
			number->InsertNextValue(int(i));
			traction->InsertNextTuple(tractionOn(piece, load, factor).data());
		}
	}
	const auto result = VtkCells::New();
	result->SetPoints(points);
	result->SetCells(dim == 2 ? VTK_LINE : VTK_TRIANGLE, cells);
	result->GetCellData()->AddArray(traction);
	result->GetCellData()->AddArray(number);
	return result;
}

} // namespace yade
