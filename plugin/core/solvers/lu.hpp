// SPDX-License-Identifier: GPL-2.0-or-later
// LU factorisation with pivoting (MUMPS, UMFPACK).
#pragma once
#include "core/solvers/multifrontal.hpp"

namespace gimpm {

class Lu {
public:
	/// Least pivot that MUMPS' threshold admits, over the row that is left for it.
	static constexpr double pivotOfRow = 0.01;

	Lu() = default;
	~Lu() { forget(); }
	Lu(const Lu&)            = delete;
	Lu& operator=(const Lu&) = delete;

	/// False if K is singular to working precision: a pivot below `smallestPivot` of the largest. With an ordering
	/// of rows and columns that keeps the factor sparse, pivots are taken from the diagonal where they are large
	/// enough, and it holds for all matrices that follow until forget(): MUMPS factorises it, and where that finds
	/// no good pivots, UMFPACK does and judges them. Without (null) UMFPACK looks at K for how to order it.
	bool factorise(const Csc& K, const int* ordering, double smallestPivot);

	/// K x = b or, transposed, K^T x = b, for the matrix of the last factorise(), which must still be as it was.
	bool solve(const Csc& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, bool transposed) const;

	/// The factor goes, and the pattern.
	void forget();
	void forgetFactor();

private:
	bool factorisePivoting(const Csc& K, const int* ordering, double smallestPivot);

	std::unique_ptr<Multifrontal> multifrontal_; // if K came with an ordering
	bool                          isMultifrontal_ = false;

	void *symbolic_ = nullptr, *numeric_ = nullptr; // objects of UMFPACK
};

} // namespace gimpm
