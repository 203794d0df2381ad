// SPDX-License-Identifier: GPL-2.0-or-later
// Hencky elasticity with von Mises plasticity (Coombs 2023, eqs. 8 and 9), perfect or with linear isotropic hardening
// or softening.
#pragma once
#include "core/materials/hencky.hpp"

namespace gimpm {

class VonMises {
public:
	/// yieldStress > 0 [Pa] bounds rho = sqrt(2 J2) of the Kirchhoff stress at first. The bound grows by hardening
	/// > -sqrt(6) G [Pa] times the equivalent plastic strain, and falls no further than to residualYieldStress,
	/// between 0 and yieldStress.
	VonMises(double young, double poisson, double yieldStress, double hardening = 0, double residualYieldStress = 0)
	        : elastic_(young, poisson), yield_(yieldStress), hardening_(hardening), residual_(residualYieldStress)
	{
		const double ratio = std::sqrt(2. / 3) * hardening / (2 * elastic_.shear());
		share_             = ratio / (1 + ratio);
	}

	/// Relative. A point that was returned to the yield surface lies on it to round-off, which must not decide
	/// between the elastic and the plastic tangent with which its next step starts.
	static constexpr double yieldTolerance = 1e-9;

	static constexpr std::array<InternalVariable, 1> variables { equivalentPlasticStrain };
	static constexpr bool                            mayFail = false, isShort = true, isElastic = false, isLinear = true, canBeWeakened = true;

	/// Parameters that may differ from point to point: Young's modulus, yieldStress, hardening,
	/// residualYieldStress.
	using Parameters = std::array<double, 4>;
	Parameters parameters() const { return { elastic_.young(), yield_, hardening_, residual_ }; }
	VonMises   with(const Parameters& p) const { return { p[0], elastic_.poisson(), p[1], p[2], p[3] }; }
	Parameters weakened(const Weakening& w) const
	{
		return { elastic_.young() * w.moduli, yield_ / w.strength, hardening_ * w.moduli / w.strength, residual_ / w.strength };
	}

	std::array<double, 1> initialInternals() const { return { 0 }; }

	bool isSymmetric() const { return true; }

	double young(const std::array<double, 1>&) const { return elastic_.young(); }

	/// Radial return: exact with an associated rule, because the deviator only shrinks. Of the excess over the
	/// yield stress, hardening leaves the part share_; a return that would pass the residual yield stress ends on
	/// it.
	template <class T> ResponseWith<T, 1> respond(const PrincipalValues<T>& trialStrain, const std::array<T, 1>& internals) const
	{
		const double             G      = elastic_.shear();
		const T                  third  = T(1. / 3) * (trialStrain[0] + trialStrain[1] + trialStrain[2]);
		const PrincipalValues<T> dev    = trialStrain - PrincipalValues<T>::Constant(third);
		const T                  length = sqrt(dev[0] * dev[0] + dev[1] * dev[1] + dev[2] * dev[2]), rho = T(2 * G) * length;
		const T                  yield  = atLeastResidual(T(yield_) + T(hardening_) * internals[0]);
		const auto               yields = rho > yield * T(1 + yieldTolerance);
		const T                  end    = T(1 - share_) * yield + T(share_) * rho;
		// Remaining share of the trial deviator.
		const T            theta = select(yields, atLeastResidual(end) / rho, T(1));
		PrincipalValues<T> elasticStrain;
		for (int i = 0; i < 3; ++i)
			elasticStrain[i] = select(yields, theta * dev[i] + third, trialStrain[i]);
		ResponseWith<T, 1> r;
		r.take(elastic_.respond<T>(elasticStrain, {}));
		r.internals[0] = internals[0] + T(std::sqrt(2. / 3)) * partTaken(theta) * length;

		const PrincipalValues<T> n = dev * (T(1) / select(yields, length, T(1)));
		const T shear = T(G) * theta, lambda = T(elastic_.bulk()) - T(2. / 3) * shear, growth = select(end > T(residual_), T(share_), T(0)),
		        along = select(yields, T(2 * G) * growth - T(2) * shear, T(0));
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j < 3; ++j)
				r.tangent(i, j) = along * n[i] * n[j] + (i == j ? lambda + T(2) * shear : lambda);
		r.shear.fill(shear);
		return r;
	}
	ResponseWith<double, 1> respond(const Vec3& trialStrain, const std::array<double, 1>& internals) const
	{
		return respond<double>(trialStrain, internals);
	}

private:
	template <class T> GIMPM_INLINE T atLeastResidual(const T& yield) const { return select(yield > T(residual_), yield, T(residual_)); }

	Hencky elastic_;
	double yield_, hardening_, residual_, share_;
};

} // namespace gimpm
