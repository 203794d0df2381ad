// SPDX-License-Identifier: GPL-2.0-or-later
// Symmetric Gauss-Seidel as a preconditioner of conjugate gradients that costs no product of its own.
#pragma once
#include "core/solvers/symmetric_operator.hpp"
#include <vector>

namespace gimpm {

/// A symmetric matrix with one number for a pair of nodes, whatever the components of what it is multiplied with: both
/// triangles.
struct NodePairs {
	std::vector<double> value;
	std::vector<int>    first, neighbour; ///< neighbours of each node, itself first and then rising
	std::vector<int>    upper;            ///< start of the neighbours after the node

	int    nodes() const { return int(first.size()) - 1; }
	double diagonal(int node) const { return value[first[node]]; }

	/// Brings each row into its order, and finds `upper`.
	void sort();
};

/// Gauss-Seidel preconditioner. With A = S K S, S a diagonal matrix of which D = 1 / S^2 becomes ones, and L and U what
/// is below and above it in blocks of nodes, which may be swept side by side, it is (1 + L)^-1 A (1 + U)^-1: one
/// product an iteration (Eisenstat, SIAM J. Sci. Stat. Comput. 2, 1981), and for a mass a third of the iterations that
/// the diagonal takes. D may differ from the diagonal of K: it is K + D - diag K of which all this is said.
class GaussSeidel : public SymmetricOperator {
public:
	/// `scale`: S for `columns` components a node (2, 3, 4, 6 or 9), zero for what is left out. K must outlive it.
	GaussSeidel(const NodePairs& K, Eigen::VectorXd scale, int columns);

	void            multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const override;
	Eigen::VectorXd diagonal() const override { return Eigen::VectorXd::Ones(scale_.size()); }

	/// (1 + L)^-1 S b
	Eigen::VectorXd right(const Eigen::VectorXd& b) const;

	/// S (1 + U)^-1 x: what x stands for among the unknowns of K.
	const Eigen::VectorXd& solution(const Eigen::VectorXd& x) const;

private:
	template <class F> void forNodes(F&& sweep) const; // sweep(columns, begin, end)
	void                    sweepOn(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
	template <int C> void   sweepBack(int begin, int end, const double* x) const;
	template <int C> void   sweepOn(int begin, int end, const double* x, double* y) const;

	const NodePairs& K_;
	Eigen::VectorXd  scale_;
	int              columns_;
	// (1 + U)^-1 x, and scaled; the scaled result of the second sweep.
	mutable Eigen::VectorXd half_, scaledHalf_, other_;
};

} // namespace gimpm
