// SPDX-License-Identifier: GPL-2.0-or-later
// Supernodal factorisation: Cholesky's (CHOLMOD), and in its pattern that of a matrix which is not definite, or not
// symmetric.
#pragma once
#include "core/solvers/signed_factor.hpp"

namespace gimpm {

/// Supernodal factor of matrices given by their upper triangles; entries below are ignored, but by factoriseGeneral().
class SupernodalFactor {
public:
	SupernodalFactor();
	~SupernodalFactor();
	SupernodalFactor(const SupernodalFactor&)            = delete;
	SupernodalFactor& operator=(const SupernodalFactor&) = delete;

	/// Finds the pattern of the factor, with rows and columns in the given order; of none, in one that CHOLMOD
	/// looks for. The last ones, so many as lastBlock() will be asked for, stay where they are. `isDefinite`: for
	/// factorise(), else for the other two.
	void analyse(const Csc& K, std::vector<int> order = {}, int last = 0, bool isDefinite = true);
	void forget() { cholmod_free_factor(&factor_, &common_), entries_ = above_ = {}, upper_ = {}; }
	/// Not before analyse(), nor if the factor would be too large for CHOLMOD.
	bool   isAnalysed() const { return factor_; }
	double entries() const { return common_.lnz; }
	double flops() const { return common_.fl; }
	/// Order of rows and columns: the number of each in K.
	const int* ordering() const { return static_cast<const int*>(factor_->Perm); }

	/// Factorises a matrix with the pattern that was analysed; false if it is not positive definite.
	bool factorise(const Csc& K);
	/// L S L^T with a sign for each row; false if a pivot is smaller than a part `smallest` of the largest one.
	bool factoriseSigned(const Csc& K, double smallest);
	/// L S U, of a matrix whose pattern is symmetric and whose values need not be.
	bool factoriseGeneral(const Csc& K, double smallest);
	/// A rough inverse of the factor's condition number: the square of its smallest over its largest diagonal
	/// entry.
	double rcond() { return cholmod_rcond(factor_, &common_); }
	bool   solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) { return solve(CHOLMOD_A, b, x); }

	/// Solves with the factor of factoriseSigned() or factoriseGeneral(), for the matrix or its transpose.
	bool solveSigned(const Eigen::VectorXd& b, Eigen::VectorXd& x, bool transposed = false);

	/// L x = b and L^T x = b, in the order of the factor.
	bool solveLower(const Eigen::VectorXd& b, Eigen::VectorXd& x) { return solve(CHOLMOD_L, b, x); }
	bool solveUpper(const Eigen::VectorXd& b, Eigen::VectorXd& x) { return solve(CHOLMOD_Lt, b, x); }

	/// The last rows and columns of L, as many as `block` has; what stands above the diagonal is zero.
	void lastBlock(Eigen::MatrixXd& block) const;

private:
	void analyseNodes(const Csc& K, const std::vector<int>& order);
	bool solve(int system, const Eigen::VectorXd& b, Eigen::VectorXd& x);
	bool solveTriangle(int system, bool ofUpper, const Eigen::VectorXd& b, Eigen::VectorXd& x);
	bool findDestinations(const Csc& K, bool isSymmetric);

	cholmod_common  common_;
	cholmod_factor* factor_ = nullptr;

	EntryDestinations   entries_, above_; ///< destinations of entries of K, among the values of a factor with signs; above_: none if it is symmetric
	std::vector<double> upper_;           ///< values of U^T; empty if it is L^T
	Eigen::VectorXd     signs_;           ///< in the order of the factor
};

} // namespace gimpm
