// SPDX-License-Identifier: GPL-2.0-or-later
// The discrete equilibrium of one load step: everything that stays the same while Newton's method iterates.
#pragma once
#include "core/solvers/reduce.hpp"
#include "core/stepping/model.hpp"
#include "core/stepping/report.hpp"
#include "core/stepping/share.hpp"
#include "core/terms/ghost.hpp"
#include "core/terms/internal_force.hpp"

namespace gimpm {

/// Weight and point load of each point at the end of the step [N].
template <int Dim> std::vector<Vec<Dim>> pointForces(const PointCloud<Dim>&, const Model<Dim>&, const Load<Dim>&);

template <int Dim> struct StepSystem {
	/// Step 1 and the ghost faces; reports sizes and times.
	StepSystem(const PointCloud<Dim>&, const Model<Dim>&, const Load<Dim>&, StepReport&);
	StepSystem(const StepSystem&) = delete; // the terms refer to what is here

	const Model<Dim>&           model;
	CloudBasis<Dim>             basis;
	StepPoints<Dim>             points;
	std::vector<GhostFace<Dim>> faces;
	Terms<Dim>                  terms; ///< whose sum balances the external forces
	FreeDofs                    dofs;
	Eigen::VectorXd             external;   ///< body and point forces, Dim components a node [N]
	Eigen::VectorXd             prescribed; ///< increments of the held degrees of freedom, and of nodes tied to them, zero elsewhere [m]
	Eigen::VectorXd             ownMotion;  ///< displacements by which the body goes on by itself, with the prescribed ones; empty without inertia [m]

	int nodalSize() const { return Dim * int(basis.nodes.size()); }

	bool isSymmetric() const;

	/// Rows of the nodes that this process assembles; null: all.
	const NodeShare* share() const { return share_ ? &share_->nodes() : nullptr; }

	/// Sets K up for evaluate(): pattern and zeros.
	void prepare(NodeMatrix<Dim>& K) const;

	/// Reduced tangent of all terms at the start of the step.
	LinearProblem               tangent() const;
	std::optional<PointFailure> tangent(NodeMatrix<Dim>& K) const; ///< of all nodes

	/// The sum of the terms at d: sets `force`, and K and the sizes of the forces where they are given. Of K only the share is right, rows and columns. Forces
	/// at tied nodes are given to their masters; of K that is left to whoever reduces it.
	std::optional<PointFailure> evaluate(const Eigen::VectorXd& d, Eigen::VectorXd& force, NodeMatrix<Dim>* K, Eigen::VectorXd* sizes = nullptr) const;

	/// Forces from outside among the terms at d [N].
	double fromOutside(const Eigen::VectorXd& d) const;

	/// What round-off of d leaves of forces that strains do not tell [N].
	Eigen::VectorXd roundOff(const Eigen::VectorXd& d) const;

	/// Where points are divided: the sums of the points around nodes, which each process knows of its own nodes.
	void complete(Eigen::VectorXd& nodal) const
	{
		if (model.division) share()->complete(nodal);
	}
	/// Whether this process is the one that counts the points of the patch, of those that have them.
	bool counts(const Patch<Dim>& patch) const { return !model.division || model.division->owns(patch.cell); }

	bool hasInertia() const { return ownMotion.size() > 0; }

	/// How things are as the step begins; the cloud has to be as it was then.
	Beginning<Dim> beginning() const
	{
		return { cloud_, basis, model.grid, stiffnessOf_, faces, dofs, prescribed, imbalance_, share(), model.division.get() };
	}

private:
	const PointCloud<Dim>&           cloud_;
	PointStiffness                   stiffnessOf_;
	std::function<Eigen::VectorXd()> imbalance_;
	std::unique_ptr<Share<Dim>>      share_; ///< null: there is one process

	void makeTerms(const Load<Dim>&);
	void resistPoints();
	void holdNodes(const Load<Dim>&);
};

} // namespace gimpm
