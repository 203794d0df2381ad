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

	// Surfaces as one data set
	class Surfaces {
	public:
		// `name`: of the field that holds the number of whoever has the surface.
		explicit Surfaces(const char* name)
		{
			points->SetDataTypeToDouble();
			number->SetName(name);
			traction->SetName("traction");
			traction->SetNumberOfComponents(3);
		}
		// tractionOf(i): on piece i [Pa]
		template <class F> void add(const MpmSurface& surface, size_t owner, F tractionOf)
		{
			const vtkIdType first = points->GetNumberOfPoints();
			for (const Vector3r& vertex : surface.vertices)
				points->InsertNextPoint(vertex.data());
			for (size_t i = 0; i < surface.pieces.size(); ++i) {
				cells->InsertNextCell(int(surface.pieces[i].size()));
				for (const int v : surface.pieces[i])
					cells->InsertCellPoint(first + v);
				number->InsertNextValue(int(owner));
				traction->InsertNextTuple(Vector3r(tractionOf(i)).data());
			}
		}
		VtkCells data(int dim) const
		{
			const auto result = VtkCells::New();
			result->SetPoints(points);
			result->SetCells(dim == 2 ? VTK_LINE : VTK_TRIANGLE, cells);
			result->GetCellData()->AddArray(traction);
			result->GetCellData()->AddArray(number);
			return result;
		}

	private:
		vtkNew<vtkPoints>      points;
		vtkNew<vtkCellArray>   cells;
		vtkNew<vtkIntArray>    number;
		vtkNew<vtkDoubleArray> traction;
	};
}

VtkCells loadedSurfaces(const Loads& given, Real time, int dim)
{
	Surfaces surfaces("load");
	for (size_t i = 0; i < given.loads.size(); ++i) {
		const MpmTraction& load   = *given.loads[i];
		const Real         factor = given.curveOf(load).valueAt(time);
		surfaces.add(*load.surface, i, [&](size_t piece) { return tractionOn(load.surface->pieces[piece], load, factor); });
	}
	return surfaces.data(dim);
}

VtkCells walls(const vector<shared_ptr<MpmBoundary>>& boundaries, int dim)
{
	Surfaces surfaces("boundary");
	for (size_t b = 0; b < boundaries.size(); ++b) {
		if (!boundaries[b]->surface) continue;
		const auto& tractions = boundaries[b]->tractions; // empty before the first step
		surfaces.add(*boundaries[b]->surface, b, [&](size_t i) { return i < tractions.size() ? tractions[i] : Vector3r(Vector3r::Zero()); });
	}
	return surfaces.data(dim);
}

} // namespace yade
