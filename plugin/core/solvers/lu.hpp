// SPDX-License-Identifier: GPL-2.0-or-later
// LU factorisation with pivoting (UMFPACK).
#pragma once
#include "core/solvers/csc.hpp"

namespace gimpm {

class Lu {
public:
	Lu() = default;
	~Lu() { forget(); }
	Lu(const Lu&)            = delete;
	Lu& operator=(const Lu&) = delete;

	/// False if K is singular to working precision: a pivot below `smallestPivot` of the largest.
	bool factorise(const Csc& K, double smallestPivot);

	/// K x = b or, transposed, K^T x = b, for the matrix of the last factorise(), which must still be as it was.
	bool solve(const Csc& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, bool transposed) const;

	void forget();

private:
	void* factor_ = nullptr; // of UMFPACK
};

} // namespace gimpm
