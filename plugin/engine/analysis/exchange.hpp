// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Between the bodies of a scene and the flat arrays of the core.
#include "core/grid/point_cloud.hpp"
#include "core/stepping/model.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/points/MaterialPoints.hpp"
#include <atomic>

namespace yade {

// Refuses a number of a body of points that the grid does not have, at `where`.
void requireBody(int body, int count, const string& where);

// True if the grid has a cell there.
template <int Dim> bool isOnGrid(const Vector3r& position, const gimpm::Grid<Dim>& grid)
{
	const gimpm::Vec<Dim> x = position.head<Dim>();
	return x.allFinite() && ((x - grid.origin) / grid.cellSize).cwiseAbs().maxCoeff() < grid.indexLimit;
}

// Centres of points, without those that are off the grid, which a step refuses.
template <int Dim> gimpm::PointCloud<Dim> centresOnGrid(const vector<MaterialPoint>&, const gimpm::Grid<Dim>&);

// Cells with the centre of a point, in a row; of a division, those of all processes.
template <int Dim> vector<gimpm::Key> cellsOf(const gimpm::PointCloud<Dim>&, const gimpm::Grid<Dim>&, const gimpm::Division& = {});

using MaterialList = vector<const MpmMaterial*>;

// Columns of points as a step has left them, while nobody has changed values of the points.
template <int Dim> struct LeftColumns {
	gimpm::PointCloud<Dim> cloud {};
	vector<vector<int>>    ofLaws {}; // columns of internal variables, for each material
};

inline std::atomic_long timesBodiesWereRead { 0 }; // by gather()

// Copies the points and adds their materials to the model, those that are `known` first; begins with columns that were
// left, if they are those of this model and the bodies are where the step has left them. std::invalid_argument names
// the body that cannot be computed with.
template <int Dim>
gimpm::PointCloud<Dim> gather(const vector<MaterialPoint>&, gimpm::Model<Dim>&, const MaterialList& known = {}, LeftColumns<Dim>&& left = {});

// A place beyond the period of the grid re-enters it on the other side; returns by how much it has moved back [m], 0
// where it has not.
template <int Dim> Real reenter(Real& x, int axis, const gimpm::Grid<Dim>&);

// Writes a converged state back. Before, points that have left a periodic grid re-enter it on the other side. Their
// initial positions go with them, so that displacements stay.
template <int Dim> void scatter(gimpm::PointCloud<Dim>&, const gimpm::Grid<Dim>&, const vector<MaterialPoint>&);

} // namespace yade
