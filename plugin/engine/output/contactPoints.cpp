// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/output/contactPoints.hpp"
#include "engine/conditions/contact/contact_records.hpp"
#include "engine/engines/MpmImplicitEngine.hpp"
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

namespace yade {

VtkCells contactPoints(const vector<shared_ptr<MpmContact>>& contacts)
{
	vtkNew<vtkPoints>      points;
	vtkNew<vtkCellArray>   cells;
	vtkNew<vtkDoubleArray> force, gap;
	vtkNew<vtkIntArray>    slips, body;
	points->SetDataTypeToDouble();
	force->SetName("force");
	force->SetNumberOfComponents(3);
	gap->SetName("gap");
	slips->SetName("slips");
	body->SetName("body");
	for (const auto& contact : contacts)
		forRecords(contact->records, [&](const ContactRecordOfPoint& r) {
			if (!r.touches) return;
			const vtkIdType vertex = points->InsertNextPoint(r.place.data());
			cells->InsertNextCell(1, &vertex);
			force->InsertNextTuple(r.force().data());
			gap->InsertNextValue(r.gap);
			slips->InsertNextValue(r.slips);
			body->InsertNextValue(r.body);
		});
	const auto result = VtkCells::New();
	result->SetPoints(points);
	result->SetCells(VTK_VERTEX, cells);
	for (vtkDataArray* field :
	     { static_cast<vtkDataArray*>(force), static_cast<vtkDataArray*>(gap), static_cast<vtkDataArray*>(slips), static_cast<vtkDataArray*>(body) })
		result->GetCellData()->AddArray(field);
	return result;
}

py::list touchableBodiesForPython(const shared_ptr<MpmImplicitEngine>& solver)
{
	py::list ids;
	for (const auto& contact : solver->contacts)
		for (const auto& body : bodiesOf(*contact, *solver->ownScene()))
			ids.append(body->id);
	return ids;
}

} // namespace yade
