// SPDX-License-Identifier: GPL-2.0-or-later
// One linear solve of Newton's method, with the displacements that are prescribed and the factor that is kept.
#pragma once
#include "core/solvers/linear_solver.hpp"
#include "core/stepping/step_system.hpp"

namespace gimpm {

template <int Dim> class LinearStep {
public:
	LinearStep(const StepSystem<Dim>&, LinearSolver&, StepReport&);

	/// True if the next solve moves the constrained nodes to their prescribed displacements.
	bool prescribes() const { return prescribed_.size() > 0; }
	void markPrescribedApplied() { prescribed_.resize(0); } ///< The iterate contains these displacements.

	/// Forces on the free nodes if nothing but what is prescribed grew; of several fields only.
	const Eigen::VectorXd& causedByPrescribed() const { return caused_; }
	Eigen::VectorXd        causedBy(const Eigen::VectorXd& prescribed, const NodeMatrix<Dim>& K, const Couplings& couplingBlocks) const
	{
		return system_.map.isAlone() ? Eigen::VectorXd() : forcesOf(prescribed, K, couplingBlocks);
	}

	/// step = K^-1 (residual - K_fc prescribed), with the prescribed displacements themselves; an iterative solver
	/// may leave the part `forcing` of the right side. False where K is singular.
	bool solve(const NodeMatrix<Dim>& K, const Couplings& couplingBlocks, Eigen::VectorXd residual, double forcing, Eigen::VectorXd& step);

	/// The same with the factor that is kept.
	bool solveAgain(const Eigen::VectorXd& residual, Eigen::VectorXd& step);

	/// Work of forces on the free degrees of freedom, scaled as the residual, on a step.
	double product(const Eigen::VectorXd& step, const Eigen::VectorXd& force) const;

	/// True if the factor of the last solve is kept: of Cholesky or, where K is not symmetric, of LU.
	bool keepsFactor() const { return keepsFactor_; }
	void dropFactor() { keepsFactor_ = false; }

private:
	template <class F> void forFree(F&& f) const; // f(unknown, number, scale)

	Eigen::VectorXd forcesOf(const Eigen::VectorXd& growth, const NodeMatrix<Dim>& K, const Couplings& couplingBlocks) const;
	Eigen::VectorXd withSigns(Eigen::VectorXd residual) const;

	void addTo(Eigen::VectorXd& step, const Eigen::VectorXd& correction) const;

	const StepSystem<Dim>& system_;
	LinearSolver&          solver_;
	StepReport&            report_;
	LinearMethod           method_;
	Eigen::VectorXd        prescribed_; // empty once it is part of the iterate
	Eigen::VectorXd        caused_;
	bool                   keepsFactor_ = false;
	bool                   hasSigns_    = false; // the last matrix: Field::sign
};

} // namespace gimpm
