// SPDX-License-Identifier: GPL-2.0-or-later
// Cost of a load step, before it is made.
#pragma once
#include "core/grid/point_cloud.hpp"
#include "core/stepping/model.hpp"
#include "core/stepping/report.hpp"

namespace gimpm {

struct Workload {
	int         points = 0, nodes = 0, dofs = 0, populatedCells = 0, ghostFaces = 0;
	double      blockEntries  = 0; ///< numbers that the matrix takes before it is reduced
	double      matrixEntries = 0; ///< stored of the reduced matrix: where it is symmetric the lower triangle
	double      factorEntries = 0; ///< numbers of its Cholesky factor; 0 if an iterative solver takes its place
	double      factorFlops   = 0; ///< operations of a factorisation
	int         iterations    = 0; ///< iterations of an iterative solver, to 1e-3
	std::string obstacle;          ///< why no step can be made, a clause; then there are no numbers
	StepTimes   times;             ///< times of the parts of a step with one solve; measured, but for a factorisation that would take long
};

/// Does the parts of a load step once, from the current state and without load, and leaves the points alone. A
/// factorisation of more than some 1e10 operations is not made; its time is that at the speed of a core of 2020.
template <int Dim> Workload workload(const PointCloud<Dim>&, const Model<Dim>&);

} // namespace gimpm
