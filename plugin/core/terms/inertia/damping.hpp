// SPDX-License-Identifier: GPL-2.0-or-later
// Forces that resist velocities.
#pragma once
#include "core/terms/term.hpp"

namespace gimpm {

/// One kind of forces on the nodes that are linear in their velocities v, a part of inertia
/// (core/terms/inertia/inertia.hpp), which knows v: C v - what drives. It lives for one attempt at a step, as terms do.
template <int Dim> class Damping {
public:
	virtual ~Damping() = default;

	/// Marks the blocks that add() writes.
	virtual void mark(NodeMatrix<Dim>&) const = 0;

	/// Adds the force at v, C times `velocityDerivative`, which is dv / dd [1/s], and absoluteContributions.
	virtual void add(const Eigen::VectorXd& v, double velocityDerivative, const AssembledTerms<Dim>&) const = 0;

	/// Adds the force at the velocities with which the step begins; where points are divided it is right at the
	/// nodes of this process, as that of add().
	virtual void addBefore(const Eigen::VectorXd& v, Eigen::VectorXd& force) const = 0;

	/// Adds C where it is diagonal, by degree of freedom [N s/m]. False: it is not.
	virtual bool addDiagonal(Eigen::VectorXd&) const { return false; }

	/// Adds the part of its force that it has taken over from what held the body, which acts whatever moves.
	virtual void addBorne(Eigen::VectorXd&) const { }

	virtual bool isSymmetric() const { return true; }

	/// Why the step cannot be made with it, a clause; empty if it can.
	virtual std::string obstacle() const { return {}; }

	/// Forces from outside of the body among those at v [N].
	virtual double fromOutside(const Eigen::VectorXd&) const { return 0; }

	/// The step has been accepted with these displacements; velocities at its beginning, and where the forces of
	/// the step are looked at.
	virtual void commit(const Eigen::VectorXd& d, const Eigen::VectorXd& before, const Eigen::VectorXd& now) = 0;

protected:
	/// Work that the forces of the step have taken, by the trapezoidal rule [J]; `share`: the nodes at which they
	/// are right in this process, if not all.
	double workTaken(
	        const Eigen::VectorXd& d, const Eigen::VectorXd& before, const Eigen::VectorXd& now, const OwnedNodes& ownedNodes = OwnedNodes::whole()) const
	{
		Eigen::VectorXd twice = Eigen::VectorXd::Zero(d.size());
		addBefore(before, twice);
		add(now, 0, { twice });
		ownedNodes.complete(twice);
		return twice.dot(d) / 2;
	}
};

/// Makes damping for a step.
template <int Dim> using DampingOfStep = std::function<std::unique_ptr<Damping<Dim>>(const StepContext<Dim>&)>;

/// One after the other: to each of them, forces that those before it have taken over belong to the balance, so that of
/// two edges with the same nodes one alone bears what has held these.
template <int Dim> std::vector<std::unique_ptr<Damping<Dim>>> dampingOf(const std::vector<DampingOfStep<Dim>>&, const StepContext<Dim>&);

} // namespace gimpm
