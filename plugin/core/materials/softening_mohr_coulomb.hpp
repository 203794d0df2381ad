// SPDX-License-Identifier: GPL-2.0-or-later
// Mohr and Coulomb's law, of which cohesion, friction and dilation fall with plastic strain to residual values. In a step
// strength is that of its beginning: the return is that of perfect plasticity, with its tangent, and softening follows
// from step to step.
#pragma once
#include "core/materials/isotropic_answer.hpp"
#include "core/materials/mohr_coulomb.hpp"

namespace gimpm {

class SofteningMohrCoulomb : public TensorLaw {
public:
	/// Of the strength that is left. `strain` > 0 is the softening strain at which it is; until then it falls
	/// linearly.
	struct Residual {
		double cohesion, frictionAngle, dilationAngle, strain;
	};
	SofteningMohrCoulomb(const MohrCoulomb& first, double poisson, const Residual& residual) : first_(first), poisson_(poisson), residual_(residual) { }

	enum {
		plasticStrain,
		softening
	}; ///< the variables, by number; the second grows with the first, or is a mean over neighbours (core/stepping/nonlocal.hpp)
	static constexpr std::array<TensorVariable, 2> variables {
		equivalentPlasticStrain, InternalVariable { "softening", "-", "plastic strain by which it has softened", -anyNumber, anyNumber }
	};
	static constexpr bool mayFail = false, isElastic = false, isLinear = true, canBeWeakened = true;

	TensorState initialInternals() const { return TensorState(variables); }

	/// Those of Mohr and Coulomb's law, before it softens, and behind them the residual ones.
	using Parameters = std::array<double, 8>;
	Parameters parameters() const
	{
		const auto [young, cohesion, friction, dilation, tension] = first_.parameters();
		return { young, cohesion, friction, dilation, tension, residual_.cohesion, residual_.frictionAngle, residual_.dilationAngle };
	}
	SofteningMohrCoulomb with(const Parameters& p) const
	{
		return { first_.with({ p[0], p[1], p[2], p[3], p[4] }), poisson_, { p[5], p[6], p[7], residual_.strain } };
	}
	Parameters weakened(const Weakening& w) const
	{
		const auto [young, cohesion, friction, dilation, tension] = first_.weakened(w);
		const double angle                                        = w.reducedAngle(residual_.frictionAngle);
		return { young, cohesion, friction, dilation, tension, residual_.cohesion / w.strength, angle, std::min(residual_.dilationAngle, angle) };
	}
	bool   isSymmetric() const { return first_.isSymmetric() && residual_.frictionAngle == residual_.dilationAngle; }
	double young(const TensorState&) const { return first_.parameters()[0]; }

	/// Where it has softened by a plastic strain.
	MohrCoulomb softened(double strain) const
	{
		const auto [young, cohesion, friction, dilation, tension] = first_.parameters();
		const double part = std::clamp(strain / residual_.strain, 0., 1.), angle = between(std::tan(friction), std::tan(residual_.frictionAngle), part);
		const double phi = part == 0 ? friction : std::atan(angle);
		return first_.with(
		        { young, between(cohesion, residual_.cohesion, part), phi, std::min(between(dilation, residual_.dilationAngle, part), phi), tension });
	}

	TensorAnswer respond(const TensorStep& step) const
	{
		const MohrCoulomb law = softened(step.state.scalar(softening));
		return answerInPrincipalAxes(step, [&](const Vec3& strain, TensorState& state) -> Response {
			const auto   r              = law.respond(strain, { state.scalar(plasticStrain) });
			const double grown          = r.internals[0] - state.scalar(plasticStrain);
			state.scalar(plasticStrain) = r.internals[0];
			state.scalar(softening) += grown;
			return r;
		});
	}
	TensorAnswer elastic(const TensorStep& step) const
	{
		return answerInPrincipalAxes(step, [&](const Vec3& strain, TensorState&) -> Response { return elasticity().respond(strain, {}); });
	}
	Mat3 strainOf(const Mat3& stress, const TensorState&) const
	{
		const double mean = stress.trace() / 3;
		return (stress - mean * Mat3::Identity()) / (2 * elasticity().shear()) + mean / (3 * elasticity().bulk()) * Mat3::Identity();
	}

private:
	static double between(double from, double to, double part) { return from + part * (to - from); }
	Hencky        elasticity() const { return { first_.parameters()[0], poisson_ }; }

	MohrCoulomb first_;
	double      poisson_;
	Residual    residual_;
};

} // namespace gimpm
