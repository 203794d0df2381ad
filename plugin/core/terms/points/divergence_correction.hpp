// SPDX-License-Identifier: GPL-2.0-or-later
// A motion of the points that changes all volumes in a cell alike, as F-bar has it.
//
// The linear functions of a cell have a dilation that differs from position to position by mixed differences of nodal
// displacements. With F-bar only that in the centre is resisted, so points would gather on one side of a cell and leave
// the other, step after step. As in the conservative interpolation of velocities of P. Jenny et al. (2001, J. Comput.
// Phys. 166: 218-252) and H. Wang et al. (2015, Geochem. Geophys. Geosyst. 16: 2015-2023), a quadratic displacement
// is added that has the difference as its dilation and moves nothing across the faces of the cell.
#pragma once
#include "core/grid/cloud_basis.hpp"
#include "core/terms/points/internal_force.hpp"

namespace gimpm {

/// Added to what the functions of the grid do to a point in a step.
template <int Dim> struct DivergenceCorrection {
	Vec<Dim> shift  = Vec<Dim>::Zero(); ///< displacement [m]
	Vec<Dim> growth = Vec<Dim>::Zero(); ///< growth of lengths along the axes
	double   hoop   = 0;                ///< and around the axis of a body of revolution
	double   ratio  = 1;                ///< ratio of the volume after the step to that before it, by F-bar
};

/// Divergence correction of each point in the order of the cloud, for displacements d of all nodes.
template <int Dim>
std::vector<DivergenceCorrection<Dim>> divergenceCorrections(
        const PointCloud<Dim>&, const CloudBasis<Dim>&, const StepPoints<Dim>&, const Grid<Dim>&, const Eigen::VectorXd& d);

} // namespace gimpm
