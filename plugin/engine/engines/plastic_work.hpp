// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/grid/point_cloud.hpp"
#include "engine/points/MaterialPoints.hpp"

namespace yade {

// Dissipated by the laws on the way from the states of the points to those of the cloud [J]: Kirchhoff stress at the
// end times the increment of plastic strain, the trial elastic strain less that at the end. With F-bar the laws have
// seen other strains: then it is that of the shear strains.
template <int Dim> Real plasticWork(const gimpm::PointCloud<Dim>&, const std::vector<gimpm::Material>&, const vector<MaterialPoint>&);

} // namespace yade
