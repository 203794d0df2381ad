// SPDX-License-Identifier: GPL-2.0-or-later
// A symmetric matrix over nodes of which each of several processes has the rows of its nodes.
#pragma once
#include "core/parallel/owned_nodes.hpp"
#include "core/solvers/block_matrix.hpp"
#include <map>

namespace gimpm {

/// A product needs what other processes have at the neighbours of the own nodes: they tell each other before it. Each
/// pair of own nodes is read once, as in one process, and each pair of an own node and another one by both processes.
template <int Dim> class SharedBlocks : public SymmetricOperator {
public:
	/// Operator on vectors of Dim components for each own node. Its processes must outlive it.
	SharedBlocks(const NodeMatrix<Dim>&, const FreeDofs&, const OwnedNodes&, const Couplings* = nullptr);

	void            multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const override;
	Eigen::VectorXd diagonal() const override;
	double          norm(const Eigen::VectorXd& x) const override;
	/// The same in all processes, to the last bit.
	void complete(double* sums, int count) const override;

private:
	using Range = typename NodeMatrix<Dim>::Range;

	/// Border with another process.
	struct Border {
		/// Nodes that the one needs of the other, which both know from their own rows.
		std::vector<int> own, others;
		Eigen::VectorXd  sent, received;
	};

	static Range hereOf(const NodeMatrix<Dim>&, const OwnedNodes&, const Couplings*);
	void         findBorders(const NodeMatrix<Dim>&, const Couplings*);
	void         fetch(const Eigen::VectorXd& x) const;

	const OwnedNodes ownedNodes_; // own copy: multigrid goes on with it in later steps
	Range            here_;       ///< own nodes and their neighbours, with what is between them
	BlockMatrix<Dim> blocks_;
	/// Couplings in the rows of own nodes, by positions among those that are here.
	std::vector<MatrixEntry>      entries_;
	mutable std::map<int, Border> borders_; ///< borders by process
	mutable Eigen::VectorXd       x_, y_;   ///< values of the nodes that are here
};

} // namespace gimpm
