// SPDX-License-Identifier: GPL-2.0-or-later
// Terms that know more than the displacements of neighbours: other fields, and nodes that are apart.
#pragma once
#include "core/fields/state.hpp"
#include "core/solvers/couplings.hpp"
#include "core/terms/term.hpp"
#include <map>
#include <optional>
#include <vector>

namespace gimpm {

/// Sum to which a term adds its part, one block a field. The sum of all terms has to vanish for fields other than the
/// displacements: their sources belong to terms, too.
template <int Dim> struct FieldSum {
	std::vector<Eigen::VectorXd>& force;                 ///< forces by field, those of the displacements [N]
	std::vector<Eigen::VectorXd>& absoluteContributions; ///< sums of the parts that make it up, whatever their signs: with them the residual is compared
	/// Derivative of the first block by displacements of neighbours, when it is asked for; reset and marked.
	NodeMatrix<Dim>* K         = nullptr;
	Couplings*       couplings = nullptr; ///< all other derivatives; with K
};

/// Growth of all fields in a step if their rates stay those of the last one, at the nodes that there were then: one
/// block a field.
struct FieldGrowth {
	std::vector<Key>             nodes; ///< sorted
	std::vector<Eigen::VectorXd> values;
};

/// A term of Term's kind in all else: what it tells of displacements alone counts as what other terms tell of them.
template <int Dim> class CoupledTerm : public Term<Dim> {
public:
	/// Marks the blocks that it adds to the matrix beside those of neighbours, for which there is mark().
	virtual void markCouplings(Couplings&) const = 0;

	/// Adds forces, absolute contributions and their derivatives at an iterate.
	virtual std::optional<PointFailure> addCoupled(const State&, const FieldSum<Dim>&) const = 0;

	/// Adds its forces as they were when the step began.
	virtual void addCoupledBefore(const State& begin, const FieldSum<Dim>& sum) const { addCoupled(begin, sum); }

	/// Adds what round-off of the unknowns leaves of its forces, where round-off of strains leaves less: of a flow
	/// by gradients, what large values of little slope leave.
	virtual void addCoupledRoundOff(const State&, std::vector<Eigen::VectorXd>& /*absoluteContributions*/) const { }

	/// From now on all derivatives are those of the forces. False if they are so already: small ones may be left
	/// out, where that makes the matrix symmetric.
	virtual bool makeExact() { return false; }

	/// Start for Newton's method; none if the term knows nothing of a last step.
	virtual std::optional<FieldGrowth> expected() const { return std::nullopt; }

	/// Local errors that the length of the step leaves, where they are asked for (NewtonSettings::stepTolerance).
	virtual std::vector<LocalError> fieldErrors(const State&) const { return {}; }

	/// The step has been accepted at this state.
	virtual void commitCoupled(const State&) { }

	void                        mark(NodeMatrix<Dim>&) const override { }
	std::optional<PointFailure> add(const Eigen::VectorXd&, const AssembledTerms<Dim>&) final { return std::nullopt; }
};

/// Makes a term for a step, from how things are when it begins; what the context refers to lasts as long as the term.
template <int Dim> using CoupledTermOfStep = std::function<std::unique_ptr<CoupledTerm<Dim>>(const StepContext<Dim>&, const State&)>;

/// Values of a field as a step begins.
struct FieldStart {
	Eigen::VectorXd       before;     ///< at all nodes
	std::map<int, double> prescribed; ///< at the end of the step, by unknown of the field; all others are free
};

/// A field besides the displacements, over the nodes of the body.
template <int Dim> struct NodalField {
	Field                                                                                       field;
	std::function<FieldStart(const PointCloud<Dim>&, const CloudBasis<Dim>&, const Grid<Dim>&)> begin;

	/// The step has been accepted: values at the nodes, and the sum of the terms there, which is what holds given
	/// values. May be empty.
	std::function<void(const CloudBasis<Dim>&, const Eigen::VectorXd& value, const Eigen::VectorXd& force)> commit {};
};

} // namespace gimpm
