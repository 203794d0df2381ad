// SPDX-License-Identifier: GPL-2.0-or-later
// A tensor law that the plugin does not have, for tests: Hencky elasticity and von Mises plasticity with a back stress
// that grows linearly (Prager), and with a viscosity if there is one.
#pragma once
#include "core/materials/tensor_law.hpp"

namespace gimpm {

class KinematicHardening : public TensorLaw {
public:
	/// The length of dev(stress) - back stress is at most yieldStress [Pa], and more by viscosity [Pa s] times the
	/// rate of plastic strain. The back stress grows by `hardening` [Pa] times the plastic strain.
	KinematicHardening(double young, double poisson, double yieldStress, double hardening, double viscosity = 0)
	        : elastic_(young, poisson), yield_(yieldStress), hardening_(hardening), viscosity_(viscosity)
	{
	}

	enum { plasticStrain, backStress }; ///< the variables, by number
	static constexpr std::array<TensorVariable, 2> variables { equivalentPlasticStrain, TensorVariable::tensor("backStress", "Pa", "back stress") };
	static constexpr bool                          mayFail = false, isElastic = false, isLinear = true, canBeWeakened = true;

	TensorState initialInternals() const { return TensorState(variables); }

	/// Parameters that may differ from point to point: Young's modulus, yieldStress, hardening.
	using Parameters = std::array<double, 3>;
	Parameters         parameters() const { return { elastic_.young(), yield_, hardening_ }; }
	KinematicHardening with(const Parameters& p) const { return { p[0], elastic_.poisson(), p[1], p[2], viscosity_ }; }
	Parameters weakened(const Weakening& w) const { return { elastic_.young() * w.moduli, yield_ / w.strength, hardening_ * w.moduli / w.strength }; }

	/// The axes of stress and trial strain differ, so that the stiffness is symmetric but for products of stresses
	/// and strains.
	bool isSymmetric() const { return false; }

	double young(const TensorState&) const { return elastic_.young(); }

	TensorAnswer respond(const TensorStep& step) const
	{
		const double G = elastic_.shear(), K = elastic_.bulk();
		const Mat3   I = Mat3::Identity(), dev = step.trialStrain - step.trialStrain.trace() / 3 * I, back = step.state.tensor(backStress);
		const Mat3   relative = 2 * G * dev - back;
		const double length = relative.norm(), excess = length - yield_;
		// Infinite where no time goes by.
		const double resistance = 2 * G + hardening_ + (viscosity_ > 0 ? viscosity_ / step.duration : 0);
		const bool   yields     = excess > 1e-9 * yield_;
		const double flow       = yields ? excess / resistance : 0;
		const Mat3   n          = yields ? Mat3(relative / length) : Mat3::Zero();
		TensorAnswer answer(step.state);
		answer.elasticStrain = step.trialStrain - flow * n;
		answer.stress        = 2 * G * (dev - flow * n) + K * step.trialStrain.trace() * I;
		answer.state.scalar(plasticStrain) += std::sqrt(2. / 3) * flow;
		answer.state.setTensor(backStress, Mat3(back + hardening_ * flow * n));
		if (!step.wantsTangent) return answer;
		const Vec6   one = toMandel(I), along = toMandel(n);
		const Mandel deviator = Mandel::Identity() - one * one.transpose() / 3;
		const double share = yields ? 2 * G / resistance : 0, turning = yields ? 2 * G * flow / length : 0;
		answer.tangent = K * one * one.transpose() + 2 * G * ((1 - turning) * deviator - (share - turning) * along * along.transpose());
		return answer;
	}

private:
	Hencky elastic_;
	double yield_, hardening_, viscosity_;
};

} // namespace gimpm
