// SPDX-License-Identifier: GPL-2.0-or-later
// The discrete equilibrium of one load step: everything that stays the same while Newton's method iterates.
#pragma once
#include "core/terms/internal_force.hpp"
#include "core/terms/ghost.hpp"
#include "core/solvers/linear_solver.hpp"
#include "core/stepping/model.hpp"
#include "core/stepping/report.hpp"

namespace gimpm {

/// Weight and point load of each point at the end of the step [N].
template <int Dim> std::vector<Vec<Dim>> pointForces(const PointCloud<Dim>&, const Model<Dim>&, const Load<Dim>&);

template <int Dim> struct StepSystem {
	/// Step 1 and the ghost faces; reports sizes and times.
	StepSystem(const PointCloud<Dim>&, const Model<Dim>&, const Load<Dim>&, StepReport&);

	const Model<Dim>&           model;
	CloudBasis<Dim>             basis;
	StepPoints<Dim>             points;
	std::vector<GhostFace<Dim>> faces;
	FreeDofs                    dofs;
	Eigen::VectorXd             external;   ///< body and point forces, Dim components a node [N]
	Eigen::VectorXd             prescribed; ///< increments of the held degrees of freedom, zero elsewhere [m]

	int nodalSize() const { return Dim * int(basis.nodes.size()); }

	/// Sets K up for evaluate(): pattern and zeros.
	void prepare(NodeMatrix<Dim>& K) const;

	/// Reduced tangent K + K_g at the start of the step.
	SymmetricCsc tangent() const;

	/// force = f_int + K_g d; also K + K_g when K is given, and when `sizes` is given the sizes of the parts that make up the force.
	InvertedPoint evaluate(const Eigen::VectorXd& d, Eigen::VectorXd& force, NodeMatrix<Dim>* K, Eigen::VectorXd* sizes = nullptr) const;
};

} // namespace gimpm
