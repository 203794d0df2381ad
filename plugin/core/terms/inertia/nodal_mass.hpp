// SPDX-License-Identifier: GPL-2.0-or-later
// From momenta of the nodes to velocities, and from forces to accelerations, without a factorisation.
#pragma once
#include "core/solvers/conjugate_gradients.hpp"
#include "core/solvers/gauss_seidel.hpp"
#include "core/solvers/reduce.hpp"
#include "core/terms/inertia/mass_matrix.hpp"

namespace gimpm {

/// All degrees of freedom, as of a body that nothing holds, but those of tied nodes.
template <int Dim> FreeDofs allFree(Eigen::Index size, const AffineConstraints& affineConstraints)
{
	FreeDofs all { std::vector<int>(size, 0), int(size), affineConstraints.empty() ? nullptr : &affineConstraints };
	for (const int node : affineConstraints.node)
		for (int a = 0; a < Dim; ++a, --all.count)
			all.number[Dim * node + a] = -1;
	return all;
}

/// Consistent mass with ghost mass, for conjugate gradients: its condition number is bounded however little of a cell
/// is filled (150 in 2D, 400 in 3D at a quarter of the density). Without ghost mass it has no bound, and the mass is
/// lumped: the sum of each row goes to its node.
template <int Dim> class NodalMass {
public:
	/// Masses by point of the cloud [kg]. Without faces it is lumped. `share`: the nodes around which this process
	/// knows all points.
	NodalMass(
	        const CloudBasis<Dim>&, const std::vector<double>& masses, const std::vector<GhostFace<Dim>>&, double h,
	        const std::vector<LooseCell<Dim>>& loose = {}, const OwnedNodes& ownedNodes = OwnedNodes::whole());
	/// Mass P^T M P with ties, where P gives all nodes from their masters: the rows of tied nodes are zero.
	explicit NodalMass(const MassMatrix<Dim>&, const AffineConstraints& = {});

	Eigen::VectorXd operator*(const Eigen::VectorXd& x) const; ///< for nodal vectors of Dim components a node

	struct Side {
		const Eigen::VectorXd& right;
		const FreeDofs&        dofs;
		Eigen::VectorXd&       x; ///< comes with the values of the constrained degrees of freedom
	};
	struct Effort {
		double tolerance = 1e-13; ///< part of the right side, about; momentum is as exact
		int    atMost    = mostIterations;
	};

	/// (M + C) x = right at the free degrees of freedom for up to three sides at the same time, where C is a
	/// diagonal matrix or nothing. False, with x meaningless there, if that takes more iterations or M is singular.
	/// The result does not depend on the number of threads.
	bool solve(const std::vector<Side>&, Effort = {}, const Eigen::VectorXd* C = nullptr);

	double diagonal(int node) const { return isLumped() ? lumped_[node] : rows_.diagonal(node); }

	bool isLumped() const { return rows_.value.empty(); }
	int  iterations() const { return iterations_; } ///< iterations of all solves

private:
	struct Start {
		Eigen::VectorXd rest;
		double          size; ///< size of the right side
	};

	double          sizeOf(const Eigen::VectorXd& momenta) const;
	bool            guess(const Side&, const Eigen::VectorXd* C) const;
	Eigen::VectorXd rest(const Side&, const Eigen::VectorXd* C) const;
	Start           start(const Side&, const Eigen::VectorXd* C) const;
	void            keepMomentum(const Side&, const Eigen::VectorXd* C) const;

	NodePairs           rows_;   ///< none: lumped
	std::vector<double> lumped_; ///< sum of each row
	int                 iterations_ = 0;
};

} // namespace gimpm
