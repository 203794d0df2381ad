// SPDX-License-Identifier: GPL-2.0-or-later
// Newton's method on the incremental nodal displacements.
#pragma once
#include "core/stepping/step_system.hpp"

namespace gimpm {

struct NewtonResult {
	Eigen::VectorXd growth;    ///< fields, block by block: displacements have Dim components a node [m]
	bool            predicted; ///< it started from the prediction
};

/// Finds d with external - (sum of the terms at d) = 0 on the free degrees of freedom, starting from d = 0; prescribed
/// displacements enter with the first solve. Converged when |residual| <= tolerance |external forces + reactions|
/// (those at the start of the step, if they were larger) or when it is zero to working precision, and when around each
/// node at most three times the tolerance of the forces there is left (LocalBalance). Fills the report's failure,
/// iterations, residuals, reactions and worst degree of freedom.
///
/// A prediction (not empty) is the start unless its residual is more than twice that of zero.
template <int Dim> NewtonResult newton(const StepSystem<Dim>&, LinearSolver&, StepReport&, const Eigen::VectorXd& prediction);

} // namespace gimpm
