// SPDX-License-Identifier: GPL-2.0-or-later
// Algebraic multigrid as a preconditioner, by a library that is opened when it is needed.
#pragma once
#include "core/solvers/conjugate_gradients.hpp"
#include "core/solvers/node_problem.hpp"

namespace gimpm {

/// Multigrid preconditioner of a symmetric matrix, which it keeps: it goes on serving those that follow, as long as
/// they have the same unknowns and are not too different. Where processes share the matrix all of them call each
/// function, and it has the rows of this one.
class Multigrid : public Preconditioner {
public:
	/// The file of the library, by default mpm_petsc.so beside the one that holds the core.
	static void openFrom(const std::string& file);

	/// Opens the library. Empty, or why that fails.
	static std::string absence();

	/// Null, with the reason, if it cannot be set up. `K` is the product with the problem's matrix.
	static std::unique_ptr<Multigrid> of(const NodeProblem& problem, std::shared_ptr<const SymmetricOperator> K, std::string& reason);
	~Multigrid() override;

	bool fits(const NodeProblem&) const;

	/// Applies it to vectors like those of the product with the matrix, with zeros for the constrained degrees of
	/// freedom.
	std::string apply(const Eigen::VectorXd& r, Eigen::VectorXd& z) const override;

private:
	Multigrid(NodeRows, Unknowns, OwnedNodes, std::shared_ptr<const SymmetricOperator>);
	bool        setUp(bool hasPositions, std::string& reason);
	static void multiply(void* self, const double* x, double* y);

	NodeRows                                 rows_;
	Unknowns                                 unknowns_;
	OwnedNodes                               ownedNodes_; ///< owned nodes of the rows
	std::shared_ptr<const SymmetricOperator> K_;
	void*                                    hierarchy_ = nullptr;
	mutable Eigen::VectorXd                  in_, out_;      ///< input and output of the hierarchy
	Eigen::VectorXd                          nodal_, image_; ///< input and output of the product
};

} // namespace gimpm
