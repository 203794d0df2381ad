// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The state of an analysis as VTK data: cells with fields. In plane strain all lies in a plane of constant z.
#include "core/grid/point_cloud.hpp"
#include "core/stepping/model.hpp"
#include "engine/grid/MpmGrid.hpp"
#include "engine/points/columns.hpp"
#include <optional>
#include <vtkSmartPointer.h>

class vtkUnstructuredGrid;

namespace yade {

using VtkCells = vtkSmartPointer<vtkUnstructuredGrid>;

// The domain of each material point, in the order given, with its fields. `rule`: by which the domains deform; none:
// they do not. `withClamped`: with the field of those that are cut off at half a cell.
// `sectors`: parts into which each is revolved about the axis x = 0, one after the other; vectors and tensors turn with
// them. 0: the section.
VtkCells pointDomains(
        const vector<MaterialPoint>&, const Scene&, const MpmGrid&, const vector<const PointColumn*>& fields, std::optional<gimpm::DomainRule> rule,
        bool withClamped, int sectors);

// Columns that are fields of these points.
vector<const PointColumn*> fieldsOf(const vector<MaterialPoint>&);

// The background grid where it has material, in the same configuration. `z` is the height of the plane in plane
// strain.
template <int Dim> VtkCells populatedCells(const gimpm::PointCloud<Dim>&, const gimpm::Model<Dim>&, Real z);

// The faces that the ghost stabilisation acts on, with their stiffness; none if it is switched off.
template <int Dim> VtkCells stabilisedFaces(const gimpm::PointCloud<Dim>&, const gimpm::Model<Dim>&, Real z);

} // namespace yade
