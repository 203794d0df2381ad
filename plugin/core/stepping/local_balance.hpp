// SPDX-License-Identifier: GPL-2.0-or-later
// Equilibrium of every part of the body: out-of-balance forces against the forces that act where they are.
#pragma once
#include "core/stepping/step_system.hpp"

namespace gimpm {

/// One norm over the whole body does not see a soft or lightly loaded part beside a stiff or strongly loaded one. So the same is asked of
/// the nodes around each node, up to one cell away: what is left there of the residual, over the forces there. Neighbours together, because
/// a node that the body hardly touches has next to no forces of its own, and because each node of a soft part has some neighbourhood that
/// reaches no stiff one.
template <int Dim> class LocalBalance {
public:
	/// All are kept by reference.
	LocalBalance(const StepSystem<Dim>& system, const NodeMatrix<Dim>& K) : system_(system), K_(K) { }

	/// The largest ratio over all neighbourhoods of residual to forces, if that is above `enough`; else an upper bound of it. The forces are
	/// those of the patches, whatever their signs, with the ghost forces and the external ones (`sizes`, from evaluate()); where these are
	/// too small for that, as after unloading, also those of the stresses at the start of the step and those that prescribed displacements
	/// can cause. What is round-off of the displacements d is no residual.
	double ratio(const Eigen::VectorXd& residual, const Eigen::VectorXd& sizes, const Eigen::VectorXd& d, double enough);

	/// The node where it is largest; -1 before the first call.
	int worstNode() const { return worst_; }

private:
	double          largest(const Eigen::VectorXd& residual, const Eigen::VectorXd& sizes);
	Eigen::VectorXd lengths(const Eigen::VectorXd& nodal) const;
	Eigen::VectorXd around(const Eigen::VectorXd& ofNode) const;
	double          largestStrain(const Eigen::VectorXd& d) const;
	template <class F> Eigen::VectorXd elasticForces(F&& strain) const;

	const StepSystem<Dim>& system_;
	const NodeMatrix<Dim>& K_;
	int                    worst_ = -1;
};

} // namespace gimpm
