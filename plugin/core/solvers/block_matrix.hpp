// SPDX-License-Identifier: GPL-2.0-or-later
// A symmetric matrix over nodes as conjugate gradients read it: block by block, in several threads.
#pragma once
#include "core/solvers/reduce.hpp"
#include "core/solvers/symmetric_operator.hpp"

namespace gimpm {

/// Vectors have Dim components a node. Rows and columns of constrained degrees of freedom are those of the identity.
template <int Dim> class BlockMatrix : public SymmetricOperator {
public:
	using Range = typename NodeMatrix<Dim>::Range;

	BlockMatrix(const NodeMatrix<Dim>&, const FreeDofs&);

	/// Blocks in the rows and columns of the nodes `own`, among the nodes `here`, which must contain their
	/// neighbours and are numbered from the first one on. The other rows of a product say nothing.
	BlockMatrix(const NodeMatrix<Dim>&, const FreeDofs&, const Range& here, const Range& own);

	/// The result does not depend on the number of threads. With two of them it takes less than half as long as the
	/// product with the same matrix in compressed columns.
	void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const override;

	Eigen::VectorXd diagonal() const override;

private:
	static constexpr int block = Dim * Dim;

	int  nodes() const { return int(first_.size()) - 1; }
	void cutIntoSlabs();
	void multiplySlab(int slab, const double* x, double* y) const;

	std::vector<int>    first_; ///< block of each node, its own; blocks follow in the order of the neighbours
	std::vector<int>    neighbour_;
	std::vector<double> value_; ///< row by row
	std::vector<int>    slab_;  ///< first node of each slab: its rows reach into the next one at most
};

} // namespace gimpm
