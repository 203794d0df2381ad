// SPDX-License-Identifier: GPL-2.0-or-later
// Multifrontal factorisation with threshold pivoting (MUMPS).
#pragma once
#include "core/solvers/csc.hpp"
#include <memory>
#include <vector>

namespace gimpm {

/// Factorisation of matrices with a symmetric pattern and a diagonal of about one: L U or, of a symmetric one that is
/// given by one of its triangles, L D L^T with D of any signs. The pattern is analysed once, for all matrices that have
/// it.
class Multifrontal {
public:
	enum class Form { general, triangle };

	/// Analyses with an ordering of rows and columns: the number of each in K.
	Multifrontal(const Csc& K, Form, const int* ordering);
	~Multifrontal();
	Multifrontal(const Multifrontal&)            = delete;
	Multifrontal& operator=(const Multifrontal&) = delete;

	/// Factorises a matrix with the pattern that was analysed. False if a row that is left for a pivot is below
	/// `smallestRow` of the largest of K, or if the memory does not suffice.
	bool factorise(const Csc& K, double smallestRow);

	/// K x = b or, transposed, K^T x = b, for the matrix of the last factorise(), which must still be as it was.
	bool solve(const Csc& K, const Eigen::VectorXd& b, Eigen::VectorXd& x, bool transposed);

private:
	struct Instance;

	bool run(int job);

	std::unique_ptr<Instance> mumps_;
	std::vector<int>          row_, column_; // row and column of each entry of K, counted from 1
};

} // namespace gimpm
