// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/output/loadedSurfaces.hpp"
#include <Eigen/Geometry>
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
	// Size of a piece times its outward normal
	Vector3r normalOf(const vector<int>& piece, const vector<Vector3r>& x)
	{
		const Vector3r along = x[piece[1]] - x[piece[0]];
		if (piece.size() == 2) return { along[1], -along[0], 0 };
		return 0.5 * along.cross(x[piece[2]] - x[piece[0]]);
	}

	Vector3r tractionOn(const vector<int>& piece, const MpmTraction& load, Real factor)
	{
		const MpmSurface& surface = *load.surface;
		const Vector3r    now     = normalOf(piece, surface.vertices);
		const Vector3r    first   = surface.initialVertices.empty() ? now : normalOf(piece, surface.initialVertices);
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
		const Real         factor = (load.curve.empty() ? given.curveOfLoads() : gimpm::LoadCurve(load.curve)).valueAt(time);
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
