// SPDX-License-Identifier: GPL-2.0-or-later
// Unknowns that are not solved for: constrained ones, which grow as prescribed, and those of tied nodes, which follow
// others.
#pragma once
#include "core/fields/dof_map.hpp"
#include "core/grid/affine_constraints.hpp"

namespace gimpm {

/// The free ones among the unknowns of a vector over nodes: number of each, rising, -1 for the constrained ones and
/// those of tied nodes.
struct FreeDofs {
	std::vector<int>         number;
	int                      count             = 0;
	const AffineConstraints* affineConstraints = nullptr; ///< null: there are none
};

/// Constraints of all fields, whose nodes have the same ties.
struct Constraints {
	FreeDofs dofs;
	/// Growth of the constrained unknowns in the step, and of those tied to them, zero elsewhere.
	Eigen::VectorXd prescribed;

	/// Nothing is held yet; the ties must outlive it.
	void reset(const DofMap&, const AffineConstraints&);

	/// After reset(), in the order of the unknowns.
	void free(int unknown) { dofs.number[unknown] = dofs.count++; }
	void prescribe(int unknown, double growth) { prescribed[unknown] = growth; }

	/// Those of the displacements alone.
	Constraints ofDisplacements(const DofMap&) const;

	/// Gives the tied nodes the values that follow from their masters. Dim: components of the displacements.
	template <int Dim> void distribute(const DofMap&, Eigen::VectorXd& values) const;

	/// The transpose: forces at tied nodes become forces at their masters.
	template <int Dim> void condense(const DofMap&, Eigen::VectorXd& forces) const;
};

} // namespace gimpm
