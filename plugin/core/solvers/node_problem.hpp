// SPDX-License-Identifier: GPL-2.0-or-later
// Properties that a solver can use where a matrix belongs to the nodes of a grid.
#pragma once
#include "core/solvers/csc.hpp"
#include "core/solvers/elimination_order.hpp"
#include "core/solvers/node_rows.hpp"
#include "core/solvers/symmetric_operator.hpp"
#include <memory>
#include <optional>
#include <variant>

namespace gimpm {

/// Free components of the nodes.
struct Unknowns {
	std::vector<Key>  nodes;
	std::vector<bool> isFree; ///< Dim a node

	bool operator==(const Unknowns& other) const { return nodes == other.nodes && isFree == other.isFree; }
};

/// Problem in 2D and 3D alike.
struct NodeProblem {
	virtual ~NodeProblem() = default;

	virtual std::variant<SymmetricCsc, GeneralCsc> compressed() const = 0;

	virtual bool isInSpace() const = 0;

	/// Problems of several fields have no blocks.
	virtual bool isOfOneField() const = 0;
	/// True if rows of a field are those of its negative (Field::sign), so that the matrix cannot be positive
	/// definite.
	virtual bool hasSigns() const = 0;

	/// Blocks of a symmetric matrix, for vectors over all degrees of freedom, with zeros for the constrained ones;
	/// where processes share the matrix, for the rows of this one.
	virtual std::unique_ptr<SymmetricOperator> blocks() const = 0;
	/// Expands a vector of the free degrees of freedom.
	virtual Eigen::VectorXd expanded(const Eigen::VectorXd& x) const = 0;
	/// The way back; all processes call it.
	virtual Eigen::VectorXd ofFreeDofs(Eigen::VectorXd x) const = 0;

	/// For multigrid; where processes share the matrix, the rows of this one, and all call it.
	virtual std::optional<NodeRows> rows() const       = 0;
	virtual Unknowns                unknowns() const   = 0;
	virtual const OwnedNodes&       ownedNodes() const = 0; ///< owned nodes of the rows

	/// True if a factor takes more operations for each entry of a triangle, by the positions of the nodes alone.
	virtual bool needsMoreFlopsPerEntry(double flops) const = 0;

	/// Order of the free degrees of freedom, the first to be eliminated first: such that a factor has few entries,
	/// whatever the matrix's values.
	virtual Order ordering() const = 0;
};

/// The matrix and what is beside it must outlive it.
template <int Dim> std::unique_ptr<NodeProblem> nodeProblem(const NodeMatrix<Dim>&, const FreeDofs&, const OwnedNodes&, const Couplings* = nullptr);

} // namespace gimpm
