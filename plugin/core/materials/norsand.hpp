// SPDX-License-Identifier: GPL-2.0-or-later
// NorSand (Jefferies 1993) for finite strain (Borja and Andrade 2006, Critical state plasticity, part VI): sand whose
// dilation and strength go with its distance to the critical state, the state parameter. In Kirchhoff stress, with the
// elasticity of Cam clay, and the same strength for all directions of the deviator.
#pragma once
#include "core/materials/tensor_law.hpp"

namespace gimpm {

class NorSand : public TensorLaw {
public:
	/// Yield function Q - eta P with P and Q of the Kirchhoff stress, P positive in compression, and the specific
	/// volume v: eta = M / N (1 - (1 - N) (P / Pi)^(N / (1 - N))), or M (1 + ln(Pi / P)) for N = 0. Critical states
	/// are v = criticalVolume - compression ln(P / criticalPressure).
	struct Given {
		double shear, swelling, reference;                           ///< G [Pa]; slope of elastic strain over ln P; P without elastic strain [Pa]
		double ratio, compression, criticalVolume, criticalPressure; ///< M; slope of v; v at criticalPressure [Pa]
		double curvature, flowCurvature;                             ///< N of the yield function and of the potential, from 0 to below 1
		double hardening, volume;                                    ///< h; v at first
		double dilatancy;                                            ///< largest dilatancy over the state parameter, negative; -3.5 is usual
	};
	explicit NorSand(const Given&);

	enum { plasticStrain, imagePressure, specificVolume }; ///< the variables, by number
	static constexpr std::array<TensorVariable, 3> variables { equivalentPlasticStrain,
		                                                   InternalVariable { "imagePressure", "Pa", "image pressure", positive, anyNumber },
		                                                   InternalVariable { "specificVolume", "-", "specific volume", 1, anyNumber } };
	static constexpr bool                          mayFail = true, isElastic = false, isLinear = false, canBeWeakened = false;

	TensorState initialInternals() const;

	/// Parameters that may differ from point to point: shearModulus, criticalStateRatio.
	using Parameters = std::array<double, 2>;
	Parameters parameters() const { return { given_.shear, given_.ratio }; }
	NorSand    with(const Parameters&) const;
	// Strength comes with the density: there is no single one to be divided.
	Parameters weakened(const Weakening&) const { return parameters(); }

	bool isSymmetric() const { return false; }

	/// It does not know the pressure, but that it is no more than some times the image pressure.
	double young(const TensorState&) const;

	/// The image pressure is no smaller than what the stress needs.
	TensorState bearing(const Mat3& stress, TensorState) const;
	Mat3        strainOf(const Mat3& stress, const TensorState&) const;

	TensorAnswer respond(const TensorStep&) const;
	/// Response without plastic flow.
	TensorAnswer elastic(const TensorStep&) const;

private:
	/// Limits, as in Cam clay. Nothing yields by less than the tolerance, relative to the pressure. A part
	/// floorAtTip of the elastic stiffness is left at the tip (see tangentFloor of perfect plasticity). A point
	/// that has borne nothing yet has the image pressure leastImage times the reference pressure; at leastPressure
	/// times it sand comes apart.
	static constexpr double mostExponent = 100, tolerance = 1e-9, floorAtTip = 1e-8, leastImage = 1e-6, leastPressure = 1e-6;

	struct Trial;
	struct Flow;
	using Vec4 = Eigen::Vector4d;
	using Mat4 = Eigen::Matrix4d;

	double                pressureAt(double volumetric) const;
	double                volumetricAt(double pressure) const;
	double                tip() const;
	bool                  isBeyondTip(const Trial&) const;
	double                obliquity(double pressure, double image) const;
	double                imageAt(double pressure, double obliquity) const;
	std::pair<Vec4, Mat4> residual(const Trial&, const Vec4& unknown) const;
	bool                  solve(const Trial&, Vec4& unknown) const;
	Vec4                  between(const Trial&) const;
	bool                  solveByHalving(const Trial&, Vec4& unknown) const;
	Flow                  returned(const Trial&) const;
	Flow                  atTip(const Trial&) const;
	Flow                  opened(const Flow&) const;
	Response              respond(const Vec3& strain, TensorState&, double growth, bool flows) const;

	Given  given_;
	double nonAssociated_; ///< (1 - N) / (1 - N of the potential)
};

} // namespace gimpm
