// SPDX-License-Identifier: GPL-2.0-or-later
// The discrete equilibrium of one load step: everything that stays the same while Newton's method iterates.
#pragma once
#include "core/fields/shared_fields.hpp"
#include "core/solvers/reduce.hpp"
#include "core/stepping/model.hpp"
#include "core/stepping/owned_parts.hpp"
#include "core/stepping/report.hpp"
#include "core/terms/ghost.hpp"
#include "core/terms/points/internal_force.hpp"

namespace gimpm {

/// Weight and point load of each point at the end of the step [N].
template <int Dim> std::vector<Vec<Dim>> pointForces(const PointCloud<Dim>&, const Model<Dim>&, const Load<Dim>&);

template <int Dim> struct StepSystem {
	/// Step 1 and the ghost faces; reports numbers and times.
	StepSystem(const PointCloud<Dim>&, const Model<Dim>&, const Load<Dim>&, StepReport&);
	StepSystem(const StepSystem&) = delete; // the terms refer to what is here

	const PointCloud<Dim>&      cloud; ///< points as the step begins
	const Model<Dim>&           model;
	const Load<Dim>             load;
	CloudBasis<Dim>             basis;
	StepPoints<Dim>             points;
	std::vector<GhostFace<Dim>> faces;
	Terms<Dim>                  terms;             ///< terms whose sum balances the external forces
	Inertia<Dim>*               inertia = nullptr; ///< the last of them, in a time step
	/// Vectors have a block for each field, and first that of the displacements: Dim components a node.
	DofMap                 map;
	Constraints            constraints;
	const FreeDofs&        dofs       = constraints.dofs;
	const Eigen::VectorXd& prescribed = constraints.prescribed; ///< prescribed displacements [m]
	Eigen::VectorXd        external;                            ///< body and point forces [N]
	Eigen::VectorXd        ghostReference;    ///< displacements of which jumps of the gradient cost nothing, by GhostSettings::memory; empty: none [m]
	Eigen::VectorXd        inertialPredictor; ///< displacements by which the body goes on by itself, with the prescribed ones; empty without inertia [m]

	/// None of them moves, whatever holds them or not; before Newton's method.
	void fixNodes(const std::vector<int>& nodes);
	bool isStill(int node) const { return !isStill_.empty() && isStill_[node]; }

	int nodalSize() const { return Dim * int(basis.nodes.size()); } ///< number of displacements

	/// The fields after they have grown so much in the step.
	State state(Eigen::VectorXd growth) const { return State(map, before_, std::move(growth)); }

	bool isSymmetric() const;

	/// CoupledTerm::makeExact() of all terms, whether one has changed; the matrix is to be prepared anew.
	bool makeExact() const;

	/// CoupledTerm::expected() of the first term that knows.
	std::optional<FieldGrowth> expected() const;

	/// Rows of the nodes that this process assembles.
	const OwnedNodes& ownedNodes() const { return owned_->nodes(); }

	/// Why the system cannot be solved as it is asked for, a clause; empty if it can.
	std::string obstacle() const;

	/// Sets K up for evaluate(), and what is beside it: pattern and zeros.
	void prepare(NodeMatrix<Dim>& K, Couplings* couplingBlocks = nullptr) const;

	/// The sum of the terms at d: sets `force`, and K and the absolute contributions of the forces where they are
	/// given. Of K only the share is right, rows and columns. Forces at tied nodes are given to their masters; of K
	/// that is left to whoever reduces it. `couplingBlocks` goes with K.
	std::optional<PointFailure> evaluate(
	        const Eigen::VectorXd& d, Eigen::VectorXd& force, NodeMatrix<Dim>* K, Eigen::VectorXd* absoluteContributions = nullptr,
	        Couplings* couplingBlocks = nullptr) const;

	/// Forces of the ghost stabilisation at d, and of all terms but that and the points' resistance [N].
	Eigen::VectorXd ghostForce(const Eigen::VectorXd& d) const { return sumOf(1, isStabilised_, d); }
	Eigen::VectorXd otherForces(const Eigen::VectorXd& d) const;

	/// Forces from outside among the terms at these displacements [N].
	double fromOutside(const Eigen::VectorXd& d) const;

	/// Forces that round-off of d leaves and strains do not tell.
	Eigen::VectorXd roundOff(const Eigen::VectorXd& d) const;

	/// The sums of the points around nodes, which each process knows of the nodes around which it has all points.
	void complete(Eigen::VectorXd& nodal) const { owned_->knownNodes().complete(nodal); }

	/// Completes forces at all unknowns: each process knows the rows that it assembles, and then all.
	void completeForces(Eigen::VectorXd& all) const { gimpm::complete(ownedNodes(), map, all); }

	/// True if this process is the one that counts the points of the patch, of those that have them.
	bool counts(const Patch<Dim>& patch) const { return model.division->owns(patch.cell); }

	bool hasInertia() const { return inertia != nullptr; }
	/// Nodes that are apart, or several fields.
	bool isCoupled() const { return !coupled_.empty() || !map.isAlone(); }

	/// Those of the terms that know several fields, or nodes that are apart.
	const std::vector<CoupledTerm<Dim>*>& coupled() const { return coupled_; }

	/// The step has been accepted.
	void commit(const Eigen::VectorXd& d) const;

	/// State of the step as it begins; the cloud has to be as it was then.
	StepContext<Dim> context() const
	{
		const Constraints& held = map.isAlone() ? constraints : ofDisplacements_;
		return { cloud,
			 basis,
			 model.grid,
			 stiffnessOf_,
			 faces,
			 held.dofs,
			 held.prescribed,
			 imbalance_,
			 owned_->knownNodes(),
			 *model.division,
			 model.water ? &water_ : nullptr };
	}

private:
	PointStiffness                   stiffnessOf_;
	std::function<Eigen::VectorXd()> imbalance_;
	std::unique_ptr<OwnedParts<Dim>> owned_;
	/// The fields as the step begins; displacements are those of the step.
	std::vector<Eigen::VectorXd>   before_;
	Eigen::VectorXd                water_;                ///< StepContext::water
	Constraints                    ofDisplacements_;      ///< constraints of the displacements, with other fields
	std::vector<CoupledTerm<Dim>*> coupled_;              ///< coupled ones of the terms
	bool                           isStabilised_ = false; ///< the second of the terms is the ghost's
	std::vector<char>              isStill_;              ///< flag by node; empty: none is

	Eigen::VectorXd sumOf(std::size_t first, std::size_t count, const Eigen::VectorXd& d) const;

	void                        mapFields();
	void                        makeTerms();
	void                        resistPoints();
	void                        constrainNodes();
	void                        constrainField(int field, const FieldStart&);
	void                        addCoupledBefore(Eigen::VectorXd& resistance) const;
	Eigen::VectorXd             completed(Eigen::VectorXd force) const;
	std::optional<PointFailure> addTerms(const Eigen::VectorXd& d, const AssembledTerms<Dim>&) const;
	std::optional<PointFailure> addCoupled(
	        const Eigen::VectorXd& d, Eigen::VectorXd& force, NodeMatrix<Dim>* K, Eigen::VectorXd* absoluteContributions, Couplings* couplingBlocks) const;
};

} // namespace gimpm
