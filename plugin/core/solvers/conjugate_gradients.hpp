// SPDX-License-Identifier: GPL-2.0-or-later
// The iterative way through step 4, for bodies whose Cholesky factor is too large: conjugate gradients, preconditioned
// with the diagonal or with something better.
#pragma once
#include "core/solvers/symmetric_operator.hpp"
#include <string>

namespace gimpm {

struct Preconditioner {
	virtual ~Preconditioner() = default;

	/// z = M r, with M symmetric positive definite and close to the inverse. Empty, or why it failed.
	virtual std::string apply(const Eigen::VectorXd& r, Eigen::VectorXd& z) const = 0;
};

/// K x = b to |b - K x| <= tolerance |b|, with the diagonal as preconditioner until precondition(). A singular K is not
/// told from a regular one if b lies in its range. The result does not depend on the number of threads.
class ConjugateGradients {
public:
	/// K must outlive it.
	ConjugateGradients(const SymmetricOperator& K, const Eigen::VectorXd& b, double tolerance);

	/// Goes on with it from the x that has been reached; null: with the diagonal again, also where the
	/// preconditioner has failed.
	void precondition(const Preconditioner*);

	/// So many iterations at most. Whether it has come to an end.
	bool iterate(int atMost);

	int    made() const { return made_; }   ///< iterations
	double error() const { return error_; } ///< |b - K x| / |b|
	bool   hasConverged() const { return error_ <= tolerance_; }

	bool hasBrokenDown() const { return !failure_.empty(); }

	/// Why the preconditioner has failed, if it has.
	const std::string& fault() const { return fault_; }

	/// Gives x if it has converged. Empty, or why not.
	std::string take(Eigen::VectorXd& x) const;

private:
	void   begin();
	bool   step();
	double improve(double length);
	double product(const Eigen::VectorXd&, const Eigen::VectorXd&) const;
	bool   preconditionResidual();
	void   fail(const char* reason) { failure_ = reason; }

	const SymmetricOperator& K_;
	const Preconditioner*    preconditioner_ = nullptr; ///< null: the diagonal
	double                   size_, tolerance_, error_;
	Eigen::VectorXd          inverse_, residual_, x_, direction_, force_; ///< vectors for a right side of size 1
	Eigen::VectorXd          preconditioned_;                             ///< residual, with a preconditioner
	double                   gain_ = 0;                                   ///< residual times preconditioned residual
	int                      made_ = 0;
	std::string              failure_, fault_;
};

/// Iterations with the diagonal after which they do not get there.
constexpr int mostIterations = 2000;

} // namespace gimpm
