// SPDX-License-Identifier: GPL-2.0-or-later
// What a solver can make use of where a matrix belongs to the nodes of a grid.
#pragma once
#include "core/solvers/csc.hpp"
#include "core/solvers/reduce.hpp"
#include "core/solvers/symmetric_operator.hpp"
#include <memory>
#include <optional>
#include <variant>

namespace gimpm {

/// Of 2D and 3D alike.
struct NodeProblem {
	virtual ~NodeProblem() = default;

	virtual std::variant<SymmetricCsc, GeneralCsc> compressed() const = 0;

	/// Of a symmetric matrix, for vectors over all degrees of freedom, with zeros for the held ones.
	virtual std::unique_ptr<SymmetricOperator> blocks() const                             = 0;
	virtual Eigen::VectorXd                    expanded(const Eigen::VectorXd& x) const   = 0;
	virtual Eigen::VectorXd                    ofFreeDofs(const Eigen::VectorXd& x) const = 0;

	/// Whether a factor takes more operations for each entry of a triangle, by the places of the nodes alone.
	virtual bool needsMoreFlopsPerEntry(double flops) const = 0;
};

/// The matrix and the degrees of freedom must outlive it.
template <int Dim> std::unique_ptr<NodeProblem> nodeProblem(const NodeMatrix<Dim>&, const FreeDofs&);

} // namespace gimpm
