// SPDX-License-Identifier: GPL-2.0-or-later
// Linear solves of Newton's method, with the factor that is kept for another one.
#pragma once
#include "core/solvers/linear_solver.hpp"
#include "core/stepping/residual.hpp"

namespace gimpm {

template <int Dim> class LinearStep {
public:
	/// All are kept by reference.
	LinearStep(const StepSystem<Dim>& system, LinearSolver& solver, StepReport& report) : system_(system), solver_(solver), report_(report) { }

	/// Adds K^-1 (r - caused) to the free unknowns of the step; the forces `caused` may be empty. An iterative
	/// solver may leave the part `forcing` of the right side. False where K is singular.
	bool solve(const Residual<Dim>&, const Eigen::VectorXd& caused, double forcing, Eigen::VectorXd& step);

	/// The same with the factor that is kept, without forces besides r.
	bool solveAgain(const Eigen::VectorXd& residual, Eigen::VectorXd& step);

	/// Work of forces on the free degrees of freedom, scaled as the residual, on a step.
	double work(const Eigen::VectorXd& step, const Eigen::VectorXd& force) const;

	/// True if the factor of the last solve is kept: of Cholesky or, where K is not symmetric, of LU.
	bool keepsFactor() const { return keepsFactor_; }
	void dropFactor() { keepsFactor_ = false; }

private:
	template <class F> void forFree(F&& f) const; // f(unknown, number, scale)

	Eigen::VectorXd withSigns(Eigen::VectorXd residual) const;
	void            addTo(Eigen::VectorXd& step, const Eigen::VectorXd& correction) const;

	const StepSystem<Dim>& system_;
	LinearSolver&          solver_;
	StepReport&            report_;
	LinearMethod           method_      = system_.model.newton.linearSolver;
	bool                   keepsFactor_ = false;
	bool                   hasSigns_    = false; // the last matrix: Field::sign
};

} // namespace gimpm
