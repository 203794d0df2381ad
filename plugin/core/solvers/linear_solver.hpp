// SPDX-License-Identifier: GPL-2.0-or-later
// Step 4: the linear system on the free degrees of freedom.
#pragma once
#include "core/solvers/kept_factor.hpp"
#include "core/solvers/linear_method.hpp"
#include "core/solvers/linear_problem.hpp"
#include <memory>

namespace gimpm {

class DistributedSolver;
class NodeSolver;

/// Direct solver: supernodal Cholesky (CHOLMOD), L S L^T with signs S for a symmetric matrix of several fields, which
/// is not positive definite, L S U for a matrix that is not symmetric (both with pivoting by MUMPS, if need be, and
/// UMFPACK judges what that refuses), and LU for one that is symmetric and not positive definite (UMFPACK). The
/// symbolic analysis is repeated only when the pattern changes. On demand conjugate gradients (alone or with multigrid)
/// or, for a matrix that is not symmetric, GMRES. Of several fields GMRES where conjugate gradients are not for it, and
/// with multigrid GMRES. One object serves one thread.
class LinearSolver {
public:
	using Status = SolverStatus;

	LinearSolver();
	~LinearSolver();
	LinearSolver(LinearSolver&&) noexcept;
	LinearSolver& operator=(LinearSolver&&) noexcept;

	/// K x = b. On `singular` (a pivot is lost in round-off, whatever the scale of its row) x is meaningless.
	Status solve(const LinearProblem& K, const Eigen::VectorXd& b, Eigen::VectorXd& x);

	/// The same by the given method; where that is iterative, to |b - K x| <= tolerance |b|. What cannot be solved
	/// so is solved directly. A singular matrix whose range contains b is not found so. What several processes
	/// share they solve together.
	Status solve(const LinearProblem& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, LinearMethod, double tolerance);

	/// Iteratively, whatever it takes; false, with x meaningless, if it fails. Multigrid is for symmetric matrices
	/// over nodes, and for those of several fields.
	bool solveIteratively(const LinearProblem& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, double tolerance, LinearMethod = LinearMethod::iterative);

	/// True if `automatic` stands for `iterative`.
	bool prefersIterative(const LinearProblem& K);

	/// True if it will be solved as it is over nodes, without being compressed.
	static bool staysOverNodes(LinearMethod, const LinearProblem& K);
	bool        isIterative(LinearMethod method, const LinearProblem& K)
	{
		return isAlwaysIterative(method) || (method == LinearMethod::automatic && prefersIterative(K));
	}

	/// Size of the factor of K, or of the two of LU, if its diagonal can be kept for the pivots, and operations
	/// that they take.
	struct FactorSize {
		double entries, flops;
	};
	FactorSize analyse(const LinearProblem& K);

	/// Another right side for the matrix of the last direct solve(), or for its transpose.
	bool solveAgain(const Eigen::VectorXd& b, Eigen::VectorXd& x, bool transposed = false);

	const SolverTimes& times() const { return times_; }
	void               resetTimes() { times_ = {}, effort_ = {}; }

	const IterativeEffort& iterativeEffort() const { return effort_; }

	KeptFactor kept; ///< the factor of the last direct solve

private:
	struct Direct;

	static bool isAlwaysIterative(LinearMethod method) { return method == LinearMethod::iterative || method == LinearMethod::multigrid; }
	Status      factorise(const LinearProblem& K);
	void        openTogether(const OwnedNodes&);
	std::string solveFields(const LinearProblem& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, double tolerance, LinearMethod method);
	Status      solveTogether(const LinearProblem& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, LinearMethod, double tolerance);

	std::unique_ptr<Direct>     direct_;
	std::unique_ptr<NodeSolver> overNodes_;

	/// Null before the first solve of several processes, or of several fields with multigrid.
	std::unique_ptr<DistributedSolver> together_;
	SolverTimes                        times_;
	IterativeEffort                    effort_;
};

} // namespace gimpm
