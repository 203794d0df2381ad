// SPDX-License-Identifier: GPL-2.0-or-later
// Terms, of which the discrete equilibrium of a load step is the sum.
#pragma once
#include "core/base/failure.hpp"
#include "core/grid/cloud_basis.hpp"
#include "core/parallel/division.hpp"
#include "core/parallel/owned_nodes.hpp"
#include "core/solvers/node_matrix.hpp"
#include "core/solvers/reduce.hpp"
#include "core/terms/cell_moduli.hpp"
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace gimpm {

/// A point that has no force at these displacements: the iterate cannot be evaluated.
struct PointFailure {
	enum class Reason {
		inverted,  ///< det F <= 0 or not finite, with F-bar also at the centres of the cells
		noResponse ///< its law has no answer to its strain
	};
	int    point; ///< index in the cloud; of several the smallest
	Reason reason = Reason::inverted;
};

/// Why a term does not admit an equilibrium that was found. Without a cause it does.
struct Refusal {
	Failure     failure = Failure::refused;
	std::string cause;  ///< a clause
	std::string advice; ///< remedies in sentences
};

/// Error of one quantity in a step, and its tolerance.
struct LocalError {
	double      size = 0, tolerance = std::numeric_limits<double>::infinity();
	int         order = 3; ///< it goes with this power of the length of the step
	const char* of    = "displacements";
	const char* unit  = "m";
};

/// Sum to which a term adds its part. Vectors have Dim components a node.
template <int Dim> struct AssembledTerms {
	Eigen::VectorXd& force;                           ///< [N]
	NodeMatrix<Dim>* K                     = nullptr; ///< derivative of the force [N/m], when it is asked for; reset and marked
	Eigen::VectorXd* absoluteContributions = nullptr; ///< sums of the parts that make up the force, whatever their signs, when they are asked for [N]
};

/// One kind of forces that resist the displacements d of the nodes in the step: residual = external forces - sum of the
/// terms. It lives for one attempt at a load step; what it remembers from step to step belongs to whoever makes it
/// (TermOfStep), and is written in commit().
template <int Dim> class Term {
public:
	virtual ~Term() = default;

	/// Marks the blocks of K that add() writes.
	virtual void mark(NodeMatrix<Dim>&) const = 0;

	/// Adds force, stiffness and absolute contributions at d. After a failure the sums are of no use.
	virtual std::optional<PointFailure> add(const Eigen::VectorXd& d, const AssembledTerms<Dim>&) = 0;

	/// Adds its force as it was when the step began, whatever moves or grows in the step.
	virtual void addBefore(Eigen::VectorXd& force) { add(Eigen::VectorXd::Zero(force.size()), { force }); }

	/// True if what it adds to K is symmetric.
	virtual bool isSymmetric() const { return true; }

	/// Why the step cannot be made with it, a clause; empty if it can.
	virtual std::string obstacle() const { return {}; }

	/// Forces from outside among those it adds at d, as those of a support [N], for what the residual is compared
	/// with; 0 for forces within the body.
	virtual double fromOutside(const Eigen::VectorXd&) { return 0; }

	/// Calls constrain(node, direction, position) for what keeps the body from moving there, however softly; the
	/// position is given from the node on [cells].
	using Constrain = std::function<void(int node, const Vec<Dim>& direction, const Vec<Dim>& position)>;
	virtual void restrain(const Constrain&) { }

	/// The same for what still keeps it at d, as friction does until it slips.
	virtual void restrainAt(const Eigen::VectorXd&, const Constrain& constrain) { restrain(constrain); }

	/// Why equilibrium with these displacements cannot be accepted.
	virtual Refusal refusal(const Eigen::VectorXd&) { return {}; }

	/// Local error of the displacements that the length of the step leaves.
	virtual LocalError localError(const Eigen::VectorXd&) const { return {}; }

	/// The step has been accepted with these displacements.
	virtual void commit(const Eigen::VectorXd&) { }

protected:
	/// Norm of all forces that it adds at d [N], for a term whose forces come from outside.
	double sizeOfForce(const Eigen::VectorXd& d)
	{
		Eigen::VectorXd force = Eigen::VectorXd::Zero(d.size());
		add(d, { force });
		return force.norm();
	}
};

template <int Dim> using Terms = std::vector<std::unique_ptr<Term<Dim>>>;

template <int Dim> struct GhostFace;

/// State of the step as it begins.
template <int Dim> struct StepContext {
	const PointCloud<Dim>&             cloud;
	const CloudBasis<Dim>&             basis;
	const Grid<Dim>&                   grid;
	const PointStiffness&              stiffnessOf; ///< while a term is made
	const std::vector<GhostFace<Dim>>& faces;
	const FreeDofs&                    dofs;
	/// Increments of the constrained degrees of freedom, zero elsewhere [m].
	const Eigen::VectorXd& prescribed;
	const std::function<Eigen::VectorXd()>&
	                  imbalance;  ///< while a term is made: external forces less those of the terms made before it, all as they are now [N]
	const OwnedNodes& ownedNodes; ///< the nodes around which this process knows all points; what is summed over points is completed by it
	const Division&   division;   ///< points among processes, of which this one has its own and copies
	/// Pressures of water that flows in the soil, by which it presses on what touches it, at nodes as the step
	/// begins [Pa]; null: none flows.
	const Eigen::VectorXd* water = nullptr;
};

/// Makes a term for a step.
template <int Dim> using TermOfStep = std::function<std::unique_ptr<Term<Dim>>(const StepContext<Dim>&)>;

} // namespace gimpm
