// SPDX-License-Identifier: GPL-2.0-or-later
// Equilibrium of every part of the body: out-of-balance forces against the forces that act where they are.
#pragma once
#include "core/stepping/elastic_forces.hpp"

namespace gimpm {

/// One norm over the whole body does not see a soft or lightly loaded part beside a stiff or strongly loaded one. So
/// the same is asked of the nodes around each node, up to one cell away: what is left there of the residual, over the
/// forces there. Neighbours together, because a node that the body hardly touches has next to no forces of its own, and
/// because each node of a soft part has some neighbourhood that reaches no stiff one.
template <int Dim> class LocalBalance {
public:
	/// All are kept by reference.
	LocalBalance(const StepSystem<Dim>& system, const NodeMatrix<Dim>& K) : system_(system), elastic_(system), K_(K) { }

	/// The largest ratio over all neighbourhoods of residual to forces, if that is above `enough`; else an upper
	/// bound of it. The forces are the `absoluteContributions` of the terms' (StepSystem::evaluate) and the
	/// external ones; where these are too small for that, as after unloading, also those of the stresses at the
	/// start of the step and those that prescribed displacements can cause. What is round-off of the displacements
	/// d is no residual. Of several fields each is looked at, and the least balanced one counts; there is also what
	/// prescribed growth has `caused`.
	double ratio(
	        const Eigen::VectorXd& residual, const Eigen::VectorXd& absoluteContributions, const Eigen::VectorXd& d, double enough,
	        const Eigen::VectorXd& caused) const;

private:
	double ratioOfDisplacements(const Eigen::VectorXd& nodal, const Eigen::VectorXd& absoluteContributions, const Eigen::VectorXd& d, double enough) const;
	double ratioOf(int field, const Eigen::VectorXd& residual, const Eigen::VectorXd& absoluteContributions, const Eigen::VectorXd& roundOff) const;
	Eigen::VectorXd lengths(const Eigen::VectorXd& nodal) const;
	Eigen::VectorXd around(const Eigen::VectorXd& ofNode) const;
	double          largestStrain(const Eigen::VectorXd& d) const;

	const StepSystem<Dim>& system_;
	ElasticForces<Dim>     elastic_;
	const NodeMatrix<Dim>& K_;
};

} // namespace gimpm
