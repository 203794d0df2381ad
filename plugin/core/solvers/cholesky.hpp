// SPDX-License-Identifier: GPL-2.0-or-later
// Cholesky's method, with two halves of the matrix in two threads.
#pragma once
#include "core/solvers/elimination_order.hpp"
#include "core/solvers/supernodal_factor.hpp"
#include <Eigen/Cholesky>
#include <array>

namespace gimpm {

/// Cholesky factorisation of matrices given by their upper triangles; entries below are ignored. With an order whose
/// two parts are separated by few, K has blocks A_1, A_2 of the parts, B_1, B_2 between the separator and them, and C
/// of the separator. The factor of A_h, B_h and C ends with the block L_h, and L_h L_h^T = C - B_h A_h^-1 B_h^T: both
/// are found at the same time. What is left for the separator is L_1 L_1^T + L_2 L_2^T - C. The result does not depend
/// on the number of threads.
class Cholesky {
public:
	/// Finds the pattern of the factor, in this order; of an empty one, in an order that CHOLMOD looks for. If K is
	/// not definite, for factoriseSigned() or factoriseGeneral().
	void   analyse(const Csc& K, Order, bool isDefinite = true);
	bool   isAnalysed() const; ///< not before analyse(), nor if the factor would be too large for CHOLMOD
	double entries() const { return sum(&SupernodalFactor::entries); }
	double flops() const { return sum(&SupernodalFactor::flops); }
	/// Order of rows and columns: the number of each in K.
	const int* ordering() const { return isHalved() ? order_.numbers.data() : whole_.ordering(); }

	/// Factorises a matrix with the pattern that was analysed; false if it is not positive definite.
	bool factorise(const Csc& K);
	/// A rough inverse of the factor's condition number: the square of its smallest over its largest diagonal
	/// entry.
	double rcond();
	bool   solve(const Eigen::VectorXd& b, Eigen::VectorXd& x);

	/// Factorises like SupernodalFactor, in one part.
	bool factoriseSigned(const Csc& K, double smallest) { return !isHalved() && whole_.factoriseSigned(K, smallest); }
	bool factoriseGeneral(const Csc& K, double smallest) { return !isHalved() && whole_.factoriseGeneral(K, smallest); }
	bool solveSigned(const Eigen::VectorXd& b, Eigen::VectorXd& x, bool transposed = false) { return whole_.solveSigned(b, x, transposed); }

private:
	struct Half {
		SupernodalFactor factor;
		/// Numbers in K of those of the half and then of the separator, in the order of elimination.
		std::vector<int> rows;
		Csc              K;             ///< matrix of these rows, in the order of K
		std::vector<int> source;        ///< position in K of each entry
		Eigen::MatrixXd  last, product; ///< L_h, and L_h L_h^T
		Eigen::VectorXd  x;
		bool             hasDone = false;
	};

	bool   isHalved() const { return order_.first > 0; }
	int    separator() const { return int(order_.numbers.size()) - order_.first - order_.second; }
	auto   separatorRows() const { return Eigen::Map<const Eigen::VectorXi>(order_.numbers.data() + order_.first + order_.second, separator()); }
	double sum(double (SupernodalFactor::*of)() const) const;
	void   analyseHalf(Half&, const Csc& K, int first, int count);
	template <class F> bool forHalves(F&&);
	bool                    factoriseSeparator(const Csc& K);

	SupernodalFactor            whole_;
	Order                       order_; ///< without parts: whole
	std::array<Half, 2>         halves_;
	Eigen::LLT<Eigen::MatrixXd> ofSeparator_;
};

} // namespace gimpm
