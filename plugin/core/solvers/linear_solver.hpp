// SPDX-License-Identifier: GPL-2.0-or-later
// Step 4: the symmetric linear system on the free degrees of freedom.
#pragma once
#include "core/solvers/node_matrix.hpp"
#include <memory>

namespace gimpm {

/// Lower triangle of a symmetric sparse matrix in compressed columns; rows ascend within a column.
struct SymmetricCsc {
	std::vector<int>    start, row; ///< pattern: column c has entries start[c] ... start[c + 1] - 1
	std::vector<double> value;

	int size() const { return int(start.size()) - 1; }

	Eigen::VectorXd operator*(const Eigen::VectorXd&) const;
};

/// The free degrees of freedom among Dim a node: number of each, -1 for the held ones.
struct FreeDofs {
	std::vector<int> number;
	int              count = 0;
};

/// Copies the pattern and the values of the free rows and columns of K.
template <int Dim> void reduce(const NodeMatrix<Dim>& K, const FreeDofs&, SymmetricCsc& out);

struct SolverTimes {
	double analyse = 0, factorise = 0, solve = 0; ///< [s]
};

struct IterativeEffort {
	int iterations = 0; ///< of conjugate gradients
	int fallbacks  = 0; ///< solves that they left to the direct solver
};

/// `automatic`: conjugate gradients where a Cholesky factor would take much longer.
enum class LinearMethod { automatic, direct, iterative };

/// Direct solver: supernodal Cholesky (CHOLMOD), and LU with pivoting (UMFPACK) for a matrix that is not positive definite. The symbolic
/// analysis is repeated only when the pattern changes. Conjugate gradients on demand. One object serves one thread.
class LinearSolver {
public:
	enum class Status { cholesky, lu, singular, iterative };

	LinearSolver();
	~LinearSolver();
	LinearSolver(LinearSolver&&) noexcept;
	LinearSolver& operator=(LinearSolver&&) noexcept;

	/// K x = b. On `singular` (a pivot is lost in round-off, whatever the scale of its row) x is meaningless.
	Status solve(const SymmetricCsc& K, const Eigen::VectorXd& b, Eigen::VectorXd& x);

	/// The same by the given method; where that is conjugate gradients, to |b - K x| <= tolerance |b|. What they cannot solve is solved
	/// directly. They find no singular matrix whose range contains b.
	Status solve(const SymmetricCsc& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, LinearMethod, double tolerance);

	/// Whether `automatic` stands for conjugate gradients.
	bool prefersIterative(const SymmetricCsc& K);
	bool isIterative(LinearMethod method, const SymmetricCsc& K)
	{
		return method == LinearMethod::iterative || (method == LinearMethod::automatic && prefersIterative(K));
	}

	/// Size of the Cholesky factor of K, and operations that it takes.
	struct FactorSize {
		double entries, flops;
	};
	FactorSize analyse(const SymmetricCsc& K);

	/// Another right side for the matrix of the last solve(), which must have been by Cholesky.
	bool solveAgain(const Eigen::VectorXd& b, Eigen::VectorXd& x);

	const SolverTimes& times() const { return times_; }
	void               resetTimes() { times_ = {}, effort_ = {}; }

	const IterativeEffort& iterativeEffort() const { return effort_; }

private:
	struct Cholmod;
	std::unique_ptr<Cholmod> cholmod_;
	SymmetricCsc             scaled_; // the last matrix, rows and columns in the opposite order; its pattern is that of the symbolic analysis
	Eigen::VectorXd          scale_;  // of rows and columns, in their own order
	SolverTimes              times_;
	IterativeEffort          effort_;
};

} // namespace gimpm
