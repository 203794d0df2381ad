// SPDX-License-Identifier: GPL-2.0-or-later
// Perfect plasticity on elasticity whose moduli go with a power of the pressure (Houlsby, Amorosi and Rojas 2005,
// Elastic moduli of soils dependent on pressure: a hyperelastic formulation, Geotechnique 55). There is an energy of
// the elastic strain, so that no closed cycle gives or takes any.
//
// Houlsby's energy is a function f of that of Hencky's elasticity W = (K e_v^2 + 2 G e:e) / 2, with e_v the volumetric
// and e the deviatoric elastic strain: so the Kirchhoff stress is Hencky's times one number, the stiffness s = f'(W).
// A return with Hencky's elasticity, in turn, depends on the trial stress only. What the law without the power answers
// to s times the trial strain is therefore the return with these moduli, whatever its faces and edges, if s belongs to
// the elastic strain that is left: one equation for one unknown.
#pragma once
#include "core/materials/drucker_prager.hpp"
#include "core/materials/mohr_coulomb.hpp"
#include "core/materials/tensor_law.hpp"
#include <optional>
#include <variant>

namespace gimpm {

class PowerElastic : public TensorLaw {
public:
	using Strength = std::variant<MohrCoulomb, DruckerPrager>;

	/// Young's modulus [Pa] > 0 and Poisson's ratio > -1, < 0.5 at the mean pressure `reference` [Pa] > 0, all
	/// around; 0 < power < 1.
	struct Moduli {
		double young, poisson, power, reference;
	};
	/// The law with Hencky's elasticity is made for such a Young's modulus and Poisson's ratio: the bulk modulus K
	/// is the secant one from no strain to `reference`.
	static Hencky secant(const Moduli&);

	/// `strength` has the moduli secant(moduli).
	PowerElastic(const Moduli&, const Strength& strength);

	enum { plasticStrain, stiffness }; ///< the variables, by number
	static constexpr std::array<TensorVariable, 2> variables {
		equivalentPlasticStrain, InternalVariable { "stiffness", "-", "modulus over that at the reference pressure", positive, anyNumber }
	};
	static constexpr bool mayFail = true, isElastic = false, isLinear = false, canBeWeakened = true;

	TensorState initialInternals() const;

	/// Parameters that may differ from point to point: Young's modulus, cohesion, frictionAngle, dilationAngle,
	/// tensileStrength.
	using Parameters = std::array<double, 5>;
	Parameters   parameters() const;
	PowerElastic with(const Parameters&) const;
	Parameters   weakened(const Weakening&) const;

	bool   isSymmetric() const;
	double young(const TensorState& state) const { return state.scalar(stiffness) * moduli_.young; }

	/// Elastic strain of a stress, and the state with its stiffness.
	Mat3        strainOf(const Mat3& stress, const TensorState&) const;
	TensorState bearing(const Mat3& stress, TensorState) const;

	TensorAnswer respond(const TensorStep&) const;
	/// Response without plastic flow.
	TensorAnswer elastic(const TensorStep&) const;

private:
	/// Moduli do not fall below those at that part of the reference pressure, so that soil without stress has some.
	static constexpr double leastPressure = .01;

	double                  stiffnessOf(double energy) const;  ///< s of W
	double                  derivativeOf(double energy) const; ///< ds / dW
	double                  energyOf(const Vec3& elasticStrain) const;
	double                  stiffnessAt(const Mat3& stress) const;
	ResponseWith<double, 1> unscaled(const Vec3& strain) const;
	std::optional<double>   solve(const Vec3& trialStrain) const;
	Response                respond(const Vec3& trialStrain, TensorState&) const;

	Moduli   moduli_;
	Hencky   secant_;
	Strength strength_;
	double   exponent_, scale_, floor_; ///< s = (scale sqrt(2 W / K + floor^2))^exponent
};

} // namespace gimpm
