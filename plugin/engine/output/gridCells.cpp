// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/output/gridCells.hpp"
#include "engine/analysis/build_model.hpp"
#include "engine/analysis/exchange.hpp"
#include "engine/output/contactPoints.hpp"
#include "engine/output/loadedSurfaces.hpp"
#include "engine/points/parallel.hpp"
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkUnstructuredGrid.h>

namespace yade {

namespace {
	template <int Dim> VtkCells cells(const string& kind, const Scene& scene, const MpmImplicitEngine& solver)
	{
		const ValueLock lock;
		if (isDivided(solver))
			throw std::invalid_argument(
			        "the cells of '" + kind + "' follow from all points, and with MpmImplicitEngine.distributed no process has them.");
		auto       model = emptyModel<Dim>(solver);
		const auto cloud = gather(materialPoints(scene, solver.mask), model);
		const Real z     = solver.grid->origin[2];
		return kind == "grid" ? populatedCells(cloud, model, z) : stabilisedFaces(cloud, model, z);
	}

	py::object bytes(const vector<Real>& values)
	{
		const char* begin = reinterpret_cast<const char*>(values.data());
		return py::object(py::handle<>(PyByteArray_FromStringAndSize(begin, values.size() * sizeof(Real))));
	}
}

VtkCells gridCells(const string& kind, const Scene& scene, const MpmImplicitEngine& solver)
{
	if (kind == "loads") {
		const ValueLock lock;
		return loadedSurfaces(solver, solver.loadTime, solver.grid->dim);
	}
	if (kind == "contacts") {
		const ValueLock lock;
		return contactPoints(solver.contacts);
	}
	if (kind == "walls") {
		const ValueLock lock;
		return walls(solver.boundaries, solver.grid->dim);
	}
	return solver.grid->dim == 2 ? cells<2>(kind, scene, solver) : cells<3>(kind, scene, solver);
}

py::dict gridCellsForPython(const string& kind, const shared_ptr<MpmImplicitEngine>& solver)
{
	solver->requireAdmissible();
	requireThreadsOfThisProcess(omp_get_max_threads());
	const VtkCells    grid   = gridCells(kind, *solver->ownScene(), *solver);
	vtkDataArray&     values = *grid->GetCellData()->GetArray(0);
	const int         width  = values.GetNumberOfComponents();
	vector<Real>      corners, field;
	vtkNew<vtkIdList> nodes;
	for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
		grid->GetCellPoints(cell, nodes);
		for (vtkIdType n = 0; n < nodes->GetNumberOfIds(); ++n) {
			const double* x = grid->GetPoint(nodes->GetId(n));
			corners.insert(corners.end(), x, x + 3);
		}
		for (int i = 0; i < width; ++i)
			field.push_back(values.GetComponent(cell, i));
	}
	py::dict result;
	result["corners"] = bytes(corners);
	result["field"]   = bytes(field);
	return result;
}

} // namespace yade
