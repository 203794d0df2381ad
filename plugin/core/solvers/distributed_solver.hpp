// SPDX-License-Identifier: GPL-2.0-or-later
// Linear systems that several processes solve together.
#pragma once
#include "core/solvers/linear_method.hpp"
#include "core/solvers/node_solver.hpp"

namespace gimpm {

/// Each process has the rows of its nodes and comes to know the whole x. `direct`: MUMPS. `iterative`, `multigrid` and
/// `automatic`: conjugate gradients as in one process. Where K is not symmetric, or of several fields, all of these are
/// GMRES with multigrid of its symmetric part, field by field, which is kept for the solves that follow. What cannot be
/// solved so is solved directly.
class DistributedSolver {
public:
	/// The library must be open.
	explicit DistributedSolver(bool isShared);
	~DistributedSolver();
	DistributedSolver(const DistributedSolver&)            = delete;
	DistributedSolver& operator=(const DistributedSolver&) = delete;

	bool isShared() const { return isShared_; } ///< several processes share the matrix

	/// K x = b on the free degrees of freedom; iteratively to |b - K x| <= tolerance |b|.
	SolverStatus solve(
	        const NodeProblem&, bool isSymmetric, const Eigen::VectorXd& b, Eigen::VectorXd& x, LinearMethod, double tolerance, SolverTimes&,
	        IterativeEffort&);

	/// Solves by GMRES with multigrid, also in one process. Empty, or why it fails.
	std::string solveWithMultigrid(
	        const NodeProblem&, bool isSymmetric, const Eigen::VectorXd& b, Eigen::VectorXd& x, double tolerance, SolverTimes&, IterativeEffort&);

	/// True if the last solve has left a factor; solves another right side with it.
	bool hasFactor() const { return factor_ != nullptr; }
	bool solveAgain(const Eigen::VectorXd& b, Eigen::VectorXd& x);

private:
	struct Partition;
	struct Task;
	struct Factor;

	bool         iterate(Task&, LinearMethod);
	bool         iterateWithMultigrid(Task&);
	bool         giveMatrix(Task&);
	bool         run(Task&, int atMost);
	void         setUp(Task&);
	SolverStatus factorise(Task&);

	bool                    isShared_;
	void*                   solver_;        ///< solver of the library, where K is not symmetric or of several fields, and for factors
	Unknowns                unknowns_;      ///< unknowns of its multigrid; none: there is none
	std::vector<int>        start_;         ///< start of the nodes of each process, for multigrid
	double                  perDecade_ = 0; ///< iterations of the first solve with multigrid
	std::unique_ptr<Factor> factor_;        ///< factor of the last solve
	NodeSolver              overNodes_;     ///< solver where K is symmetric
};

} // namespace gimpm
