// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Between the bodies of a scene and the flat arrays of the core.
#include "core/grid/point_cloud.hpp"
#include "core/stepping/model.hpp"
#include "engine/analysis/MpmGhost.hpp"
#include "engine/analysis/MpmNewton.hpp"
#include "engine/conditions/boundary/MpmBoundary.hpp"
#include "engine/grid/MpmGrid.hpp"
#include "engine/points/MaterialPoints.hpp"

namespace yade {

// What an engine is set to, as the core understands it.
template <int Dim>
gimpm::Model<Dim> toModel(const MpmGrid&, const string& basis, bool fBar, const vector<shared_ptr<MpmBoundary>>&, const MpmGhost&, const MpmNewton&);

using MaterialList = vector<const MpmMaterial*>;

// Copies the points and adds their materials to the model, those that are `known` first. std::invalid_argument names the body that cannot be computed with.
template <int Dim> gimpm::PointCloud<Dim> gather(const vector<MaterialPoint>&, gimpm::Model<Dim>&, const MaterialList& known = {});

// Half the size of the domain into which the deformation gradient stretches an initial one; a step limits it to half a cell.
Vector3r stretched(const Vector3r& halfSize0, const Matrix3r& defGrad);

// A place beyond the period of the grid re-enters it on the other side; returns by how much it has moved back [m], 0 where it has not.
template <int Dim> Real reenter(Real& x, int axis, const gimpm::Grid<Dim>&);

// Writes a converged state back. Before, points that have left a periodic grid re-enter it on the other side. Their initial positions go with them, so that
// displacements stay.
template <int Dim> void scatter(gimpm::PointCloud<Dim>&, const gimpm::Grid<Dim>&, const vector<MaterialPoint>&);

} // namespace yade
