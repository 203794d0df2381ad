// SPDX-License-Identifier: GPL-2.0-or-later
// End of an iteration, for the report.
#pragma once
#include "core/stepping/residual.hpp"

namespace gimpm {

/// Factor of the tolerance for the residual around a node over the forces there: where the whole consists of one kind
/// of soil its norm shall decide.
constexpr double localTolerance = 3;

/// Notes the failure; true, as the iteration is over.
bool fail(StepReport&, Failure, const std::string& cause);
bool fail(StepReport&, const PointFailure&);

/// True if the system cannot be solved, or one of the terms cannot act at all where it is. The report says so.
template <int Dim> bool isObstructed(const StepSystem<Dim>&, StepReport&);

/// The tangent as the step begins, of all nodes. False if there is none, and the report says why.
template <int Dim> bool tangent(const StepSystem<Dim>&, NodeMatrix<Dim>&, Couplings& couplingBlocks, StepReport&);

std::string causeOfStall(double residual, double attained, double tolerance);
std::string causeOfTooMany(const StepReport&, double tolerance, bool isWholeInBalance, int iterations);
std::string causeOfDivergence(double correction);
std::string causeOfStabilised(const StepReport&, double allowed);

/// Reports the node of the largest out-of-balance force.
template <int Dim> void reportWorst(const StepSystem<Dim>&, const Residual<Dim>&, StepReport&);

/// Reactions of each of the boundary's boxes, from the sum of the terms [N].
template <int Dim> std::vector<Vec3> reactions(const StepSystem<Dim>&, const Eigen::VectorXd& force);

/// Force on constrained nodes that no box of the boundary constrains, as their points are loose [N].
template <int Dim> Vec3 looseForce(const StepSystem<Dim>&, const Eigen::VectorXd& force);

/// Part of the work at the nodes of its faces that the stabilisation takes up when the nodes go to d, 0 to 1 [-]:
/// |d . g| / (|d . g| + sum over their unknowns of |d p|), with its forces g and those p of the points' stress.
/// NaN of time steps, where inertia bears what is out of balance, and of several fields.
///
/// `force`: the sum of the terms at d [N].
template <int Dim> double ghostWorkRatio(const StepSystem<Dim>&, const Eigen::VectorXd& d, const Eigen::VectorXd& force);

} // namespace gimpm
