// SPDX-License-Identifier: GPL-2.0-or-later
// Conjugate gradients for a symmetric matrix over nodes, with multigrid where the diagonal does not get them there.
#pragma once
#include "core/solvers/linear_method.hpp"
#include "core/solvers/multigrid.hpp"

namespace gimpm {

/// Multigrid is kept for the solves that follow, until they need half as many iterations again as the first one, or
/// have other unknowns.
class NodeSolver {
public:
	/// K x = b to |b - K x| <= tolerance |b|. Empty, or why it fails. The result does not depend on the number of
	/// threads.
	std::string solve(const NodeProblem&, const Eigen::VectorXd& b, double tolerance, LinearMethod, Eigen::VectorXd& x, SolverTimes&, IterativeEffort&);

private:
	struct Task;

	void iterate(Task&, LinearMethod);
	bool iterateWithDiagonal(Task&);
	bool iterateWithMultigrid(Task&);
	bool setUp(Task&);

	std::unique_ptr<Multigrid> multigrid_;
	double                     perDecade_ = 0; ///< iterations of its first solve
	int                        untried_   = 0; ///< hierarchies to come before the diagonal is tried again
};

} // namespace gimpm
