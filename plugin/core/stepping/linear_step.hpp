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
	void dropFactor();

	/// True if the factor of an earlier step is there for this one (NewtonSettings::keepFactor), which begins with
	/// all that is prescribed or not.
	bool takesOver(bool isComplete);

	/// True if the factor that is kept is that of an earlier step, and this excess of the residual is gone after
	/// the solves with it that are left.
	bool isOfEarlierStep() const { return isOld_; }
	bool isOldFactorEnough(double excess) const
	{
		const NewtonSettings& newton = system_.model.newton;
		return solver_.kept.isEnough(excess, std::min(newton.keepFactor, newton.maxIterations) - again_);
	}

	/// A solve with the factor that is kept has left this part of the residual; the step has converged.
	void noteReduction(double part);
	void hasConverged();

private:
	template <class F> void forFree(F&& f) const; // f(unknown, number, scale)

	KeptFactor::Unknowns unknowns() const;

	Eigen::VectorXd withSigns(Eigen::VectorXd residual) const;
	void            addTo(Eigen::VectorXd& step, const Eigen::VectorXd& correction) const;

	const StepSystem<Dim>& system_;
	LinearSolver&          solver_;
	StepReport&            report_;
	LinearMethod           method_      = system_.model.newton.linearSolver;
	bool                   keepsFactor_ = false;
	bool                   hasSigns_    = false; // the last matrix: Field::sign
	bool                   isOld_       = false; // the factor is that of an earlier step
	int                    again_       = 0;     // solves with it
};

} // namespace gimpm
