// SPDX-License-Identifier: GPL-2.0-or-later
// Viscoplasticity over any law that flows (Duvaut and Lions 1972; Simo and Hughes 1998, Computational inelasticity,
// section 2.7): with the elastic trial t_tr and the answer t_inf of the law itself, the stress after a step is (t_tr +
// r t_inf) / (1 + r), where r is the duration of the step over the relaxation time; so are what the law remembers, and
// the tangent.
#pragma once
#include "core/materials/tensor_law.hpp"

namespace gimpm {

/// L is a tensor law that has, besides respond(), elastic(step), what it would answer if nothing flowed, and
/// strainOf(stress, state).
template <class L> class Relaxing : public TensorLaw {
public:
	/// time > 0 [s].
	Relaxing(const L& law, double time) : law_(law), time_(time) { }

	/// Law with a plastic viscosity > 0 [Pa s] instead (Bingham, Perzyna): in simple shear the stress is the
	/// strength and viscosity times the rate of shear. L has a resistance() of the stress to flow [Pa].
	static Relaxing viscous(const L& law, double viscosity)
	{
		Relaxing own(law, viscosity / law.resistance());
		own.viscosity_ = viscosity;
		return own;
	}

	static constexpr auto variables = L::variables;
	static constexpr bool mayFail = L::mayFail, isElastic = L::isElastic, isLinear = L::isLinear;
	// A reduced strength would be met after some time only.
	static constexpr bool canBeWeakened = false;

	TensorState initialInternals() const { return law_.initialInternals(); }

	using Parameters = typename L::Parameters;
	Parameters parameters() const { return law_.parameters(); }
	Relaxing   with(const Parameters& p) const
	{
		if constexpr (hasResistance<L>(0))
			if (viscosity_ > 0) return viscous(law_.with(p), viscosity_);
		return { law_.with(p), time_ };
	}
	Parameters weakened(const Weakening&) const { return parameters(); }
	bool       isSymmetric() const { return law_.isSymmetric(); }
	double     young(const TensorState& state) const { return law_.young(state); }

	/// Flow until now is in the elastic strain.
	Mat3 present(const TensorStep& step) const { return law_.elastic(step).stress; }

	TensorAnswer respond(const TensorStep& step) const
	{
		const double       r     = step.duration / time_;
		const TensorAnswer trial = law_.elastic(step), flown = law_.respond(step);
		TensorAnswer       answer = flown;
		answer.failed             = trial.failed || flown.failed;
		answer.stress             = (trial.stress + r * flown.stress) / (1 + r);
		answer.tangent            = (trial.tangent + r * flown.tangent) / (1 + r);
		for (int k = 0; k < answer.state.size(); ++k)
			answer.state.numbers()[k] = (trial.state.numbers()[k] + r * flown.state.numbers()[k]) / (1 + r);
		if (!answer.failed) answer.elasticStrain = law_.strainOf(answer.stress, answer.state);
		return answer;
	}

	/// Any stress, as stresses beyond yield last for a while.
	TensorState bearing(const Mat3& stress, const TensorState& state) const
	{
		if constexpr (bears<L>(0)) return law_.bearing(stress, state);
		else
			return state;
	}
	Mat3 strainOf(const Mat3& stress, const TensorState& state) const { return law_.strainOf(stress, state); }

private:
	const L law_;
	double  time_, viscosity_ = 0; ///< 0: time_ is given

	template <class Other> static constexpr auto hasResistance(int) -> decltype(std::declval<const Other&>().resistance(), true) { return true; }
	template <class Other> static constexpr bool hasResistance(long) { return false; }
};

} // namespace gimpm
