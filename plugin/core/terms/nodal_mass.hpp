// SPDX-License-Identifier: GPL-2.0-or-later
// From momenta of the nodes to velocities, and from forces to accelerations, without a factorisation.
#pragma once
#include "core/solvers/reduce.hpp"
#include "core/solvers/symmetric_operator.hpp"
#include "core/terms/mass_matrix.hpp"

namespace gimpm {

/// Consistent mass with ghost mass, for conjugate gradients: its condition number is bounded however little of a cell is filled (150 in 2D, 400 in 3D at a quarter of
/// the density). Without ghost mass it has no bound, and the mass is lumped: the sum of each row goes to its node.
template <int Dim> class NodalMass {
public:
	/// Masses by point of the cloud [kg]. Without faces it is lumped.
	NodalMass(
	        const CloudBasis<Dim>&, const std::vector<double>& masses, const std::vector<GhostFace<Dim>>&, double h,
	        const std::vector<LooseCell<Dim>>& loose = {});

	Eigen::VectorXd operator*(const Eigen::VectorXd& x) const; ///< for nodal vectors of Dim components a node

	/// (M + C) x = right at the free degrees of freedom, where the held ones have the values that x comes with, and C is a diagonal matrix or nothing. False where it is
	/// singular. The result does not depend on the number of threads.
	bool solve(const Eigen::VectorXd& right, const FreeDofs&, Eigen::VectorXd& x, const Eigen::VectorXd* C = nullptr);

	bool isLumped() const { return neighbour_.empty(); }
	int  iterations() const { return iterations_; } ///< of all solves

private:
	class Restricted; // to free degrees of freedom

	void compress(const MassMatrix<Dim>&);
	void multiply(const double* x, double* y) const;

	std::vector<double> value_; ///< one for a pair of nodes; lumped: for each node
	std::vector<int>    first_, neighbour_;
	int                 iterations_ = 0;
};

} // namespace gimpm
