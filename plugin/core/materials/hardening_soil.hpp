// SPDX-License-Identifier: GPL-2.0-or-later
// Hardening soil (Schanz, Vermeer and Bonnier 1999, The hardening soil model: formulation and verification): moduli
// that go with a power of the smallest pressure, shear hardening along a hyperbola up to Mohr and Coulomb's strength,
// and a cap, of which the shape and hardening follow from K0nc and Eoed. In Kirchhoff stress and logarithmic strain.
//
// Three things differ from that paper. Flow is radial in the deviatoric plane, so that the direction of the deviator is
// that of the trial and a return has two unknowns, whatever is active. The shear hardening is that part of the plastic
// shear strain which shortens the most pressed axis, so that the hyperbola is met with any dilation. And the moduli of
// unloading are those of the smallest pressure as the step begins.
#pragma once
#include "core/materials/tensor_law.hpp"

namespace gimpm {

class HardeningSoil : public TensorLaw {
public:
	/// Moduli [Pa] are those at the smallest pressure `reference` [Pa], of the oedometer those at the vertical
	/// pressure `reference`. Angles in radians.
	struct Given {
		double secant, oedometric, unloading, poisson; ///< E50, Eoed, Eur, nu of unloading
		double power, failureRatio, restRatio;         ///< m from 0 to 1, Rf from 0 to below 1, K0 of first loading
		double reference, cohesion, frictionAngle, dilationAngle;
		double mostDilation; ///< extension of volume, as a logarithmic strain, from which on the soil does not dilate
	};
	explicit HardeningSoil(const Given&);

	/// Bounds of `oedometric`, between which the strains of first loading at rest leave the cap a shape: strains of
	/// elasticity and of shear hardening are less than those of the test.
	static double largestOedometric(const Given&);
	/// Least K0: below it first loading at rest would be beyond the strength at the reference pressure.
	static double leastRestRatio(const Given&);

	enum { plasticStrain, shearHardening, capPressure, stiffness, mobilisedFriction, dilated }; ///< the variables, by number
	static constexpr std::array<TensorVariable, 6> variables {
		equivalentPlasticStrain,
		InternalVariable { "shearHardening", "-", "shear hardening", 0, anyNumber },
		InternalVariable { "capPressure", "Pa", "pressure at the cap", 0, anyNumber },
		InternalVariable { "stiffness", "-", "modulus over that at the reference pressure", positive, anyNumber },
		InternalVariable { "mobilisedFriction", "rad", "mobilised friction angle", 0, 1.5707963267948966 },
		InternalVariable { "volumetricStrain", "-", "volumetric strain", -anyNumber, anyNumber }
	};
	static constexpr bool mayFail = true, isElastic = false, isLinear = false, canBeWeakened = false;

	TensorState initialInternals() const;

	/// Parameters that may differ from point to point: E50, Eoed, Eur, cohesion, frictionAngle, dilationAngle.
	using Parameters = std::array<double, 6>;
	Parameters    parameters() const;
	HardeningSoil with(const Parameters&) const;
	// Strength is met after hardening: dividing it would change the hardening, too.
	Parameters weakened(const Weakening&) const { return parameters(); }

	bool isSymmetric() const { return false; }

	double young(const TensorState& state) const { return state.scalar(stiffness) * given_.unloading; }

	/// The state that bears a stress at least: shear hardening and cap are no smaller than what the stress needs,
	/// and the modulus is that of its smallest pressure.
	TensorState bearing(const Mat3& stress, TensorState) const;
	/// Elastic strain of a stress in that state.
	Mat3 strainOf(const Mat3& stress, const TensorState&) const;

	TensorAnswer respond(const TensorStep&) const;
	/// Response without plastic flow.
	TensorAnswer elastic(const TensorStep&) const;

	const Given& given() const { return given_; }
	double       shear() const { return shear_; } ///< modulus of unloading at the reference pressure

private:
	/// Moduli do not fall further below that part of the unit of pressure. By less than the tolerance, relative to
	/// the stress, nothing yields. Of the stiffness some is left at the apex (see tangentFloor of perfect
	/// plasticity).
	static constexpr double leastPressure = .01, tolerance = 1e-9, floorAtApex = 1e-8;

	/// Along K0 at the vertical pressure `reference`.
	struct AtRest {
		double pressure, difference, mobilised;                              ///< P + shift; Q; part of the strength
		double byElasticVolume, byElasticShear, byShearVolume, byShearShear; ///< strains over the vertical pressure [1/Pa]

		explicit AtRest(const HardeningSoil&);
	};
	struct Trial;
	struct Flow;
	struct Derivatives;

	double                              factorAt(double smallest) const; ///< factor of moduli, at a smallest pressure plus shift
	double                              hyperbola(double mobilised) const;
	double                              mobilisedAt(double hardening, double smallest) const;
	double                              mostHardening(double smallest) const;
	double                              dilatancy(double mobilisedSine) const;
	double                              capAt(double before, double volumetric) const;
	Flow                                onCap(const Trial&, double pressure, double difference) const;
	Flow                                returned(const Trial&) const;
	bool                                polish(const Trial&, Flow&) const;
	Derivatives                         derivatives(const Trial&, const Flow&) const;
	Response                            respond(const Vec3& trialStrain, TensorState&, double growth, bool flows) const;
	void                                setMobilised(TensorState&, double smallest, double largest) const;
	void                                setTangent(const Trial&, const Derivatives&, const Vec3& deviator, Response&) const;
	void                                setState(const Trial&, const Flow&, TensorState&) const;
	template <class T> std::array<T, 4> residual(const Trial&, const Flow&, const std::array<T, 4>& unknown, const std::array<T, 5>& trial) const;

	Given  given_;
	double sine_, strengthRatio_, shift_, cap_, unit_; ///< sin phi; strength over pressure; c cot phi; 1 / alpha^2; reference + shift
	double initialModulus_, bulk_, shear_;             ///< modulus of the hyperbola; moduli of unloading; at the reference pressure
	double shape_ = 0, capModulus_ = 0, capUnit_ = 1;
};

} // namespace gimpm
