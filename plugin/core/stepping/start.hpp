// SPDX-License-Identifier: GPL-2.0-or-later
// Start of Newton's method.
#pragma once
#include "core/stepping/iterate.hpp"
#include "core/stepping/linear_step.hpp"

namespace gimpm {

/// A prediction may start from this many times the residual of zero: where only little load is added in a step, its
/// residual may be the larger one, and it is still much closer to the solution in what counts, which points yield. On
/// the largest slope of the paper, starting from the smaller residual takes 493 solves, this 387, and zero 752.
constexpr double toleratedStart = 2;

template <int Dim> class Start {
public:
	/// All are kept by reference.
	Start(const StepSystem<Dim>& system, Iterate<Dim>& iterate, LinearStep<Dim>& linear) : system_(system), iterate_(iterate), linear_(linear) { }

	/// Leaves d at zero, with inertia at where the body moves by itself, or at the prediction (which may be empty)
	/// if that is not much further from equilibrium. Returns whether it is there. The last evaluation is that at d,
	/// with stiffness.
	bool from(const Eigen::VectorXd& prediction, Eigen::VectorXd& d)
	{
		const bool predicts = prediction.size() > 0;
		if (!movesOn(d)) iterate_.evaluate(d, !predicts);
		iterate_.whole.begin(iterate_.balance);
		return predicts && takes(prediction, d);
	}

private:
	/// True if the body moves by itself, and to where forces can be told.
	bool movesOn(Eigen::VectorXd& d)
	{
		if (!system_.hasInertia()) return false;
		iterate_.evaluate(system_.inertialPredictor, true);
		if (iterate_.failure) return false;
		d = system_.inertialPredictor;
		linear_.markPrescribedApplied();
		return true;
	}

	/// Takes the prediction as the start unless its residual is much the larger one. Zero is given the prescribed
	/// displacements for that, without which its residual says nothing of them.
	bool takes(Eigen::VectorXd prediction, Eigen::VectorXd& d)
	{
		const Eigen::VectorXd& held = system_.prescribed;
		if (linear_.prescribes()) iterate_.evaluate(held, false);
		const double fromZero = iterate_.balance.size;
		for (int i = 0; i < prediction.size(); ++i)
			if (system_.dofs.number[i] < 0) prediction[i] = held[i];
		system_.constraints.template distribute<Dim>(system_.map, prediction);
		iterate_.evaluate(prediction, true);
		if (!(iterate_.balance.size < toleratedStart * fromZero)) {
			iterate_.evaluate(d, true);
			return false;
		}
		d = std::move(prediction);
		if (linear_.prescribes()) iterate_.enter(linear_.causedBy(held, iterate_.K, iterate_.couplingBlocks));
		linear_.markPrescribedApplied();
		return true;
	}

	const StepSystem<Dim>& system_;
	Iterate<Dim>&          iterate_;
	LinearStep<Dim>&       linear_;
};

} // namespace gimpm
