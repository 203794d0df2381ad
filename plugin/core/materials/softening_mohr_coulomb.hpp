// SPDX-License-Identifier: GPL-2.0-or-later
// Mohr and Coulomb's law, of which cohesion, friction and dilation fall with a softening strain to residual values.
//
// In a step the softening strain falls by the plastic strain of the step, so that strength grows and the stiffness
// stays positive; from step to step it grows. Over-nonlocal softening (core/stepping/nonlocal.hpp) is so: with m = 2 it
// goes with twice the mean, which is that of the beginning, less the own plastic strain. Without means it is a return
// that is exact in the limit of short steps.
#pragma once
#include "core/materials/isotropic_answer.hpp"
#include "core/materials/mohr_coulomb.hpp"

namespace gimpm {

class SofteningMohrCoulomb : public TensorLaw {
public:
	/// Residual strength. `strain` > 0 is the softening strain at which it is reached; until then strength falls
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
	bool   isSymmetric() const { return false; }
	double young(const TensorState&) const { return first_.parameters()[0]; }

	/// Law softened by a strain; where that is negative it is stronger than at first.
	MohrCoulomb softened(double strain) const
	{
		const auto [young, cohesion, friction, dilation, tension] = first_.parameters();
		const double part = std::min(strain / residual_.strain, 1.), angle = between(std::tan(friction), std::tan(residual_.frictionAngle), part);
		const double phi = part == 0 ? friction : std::atan(angle);
		return first_.with(
		        { young, between(cohesion, residual_.cohesion, part), phi, std::min(between(dilation, residual_.dilationAngle, part), phi), tension });
	}

	TensorAnswer respond(const TensorStep& step) const;
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
	static constexpr double restored = .1; ///< part of the rate of softening
	static double           between(double from, double to, double part) { return from + part * (to - from); }
	Hencky                  elasticity() const { return { first_.parameters()[0], poisson_ }; }

	Response at(const Vec3& strain, double softening) const { return softened(softening).respond(strain, { 0 }); }

	/// Strain by which strength goes in a step that begins with a softening strain `before`, with the plastic
	/// strain a > 0 of the step. Fully softened soil would be perfectly plastic, and a layer of it has no stiffness
	/// at all where there is no friction: so its strength, too, grows in a step, by a part of the rate with which
	/// it has fallen.
	double strengthStrain(double before, double a) const { return std::min(before - a, residual_.strain - restored * a); }
	double restoredBy(double before, double a) const { return before - a < residual_.strain - restored * a ? 1 : restored; }

	/// Plastic strain of a step with this strength: the more, the more it has softened.
	double plasticAt(const Vec3& strain, double softening) const { return softened(softening).respond(strain, { 0 }).internals[0]; }

	/// The plastic strain a of a step, a = plasticAt(strengthStrain(before, a)), which falls as a grows. By the
	/// rule of false position, as the return is linear in the cohesion, and by bisection where it is slow.
	double flow(const Vec3& strain, double before) const;

	/// To the tangent of perfect plasticity what follows from the strength that goes with the plastic strain: dt =
	/// D de + t_s ds, ds = -r da, da = a_e de + a_s ds; t_s and a_s from differences, as the return is nearly
	/// linear in s.
	void addHardening(const Vec3& strain, double before, double grown, Response& r) const;

	MohrCoulomb first_;
	double      poisson_;
	Residual    residual_;
};

} // namespace gimpm
