// SPDX-License-Identifier: GPL-2.0-or-later
// Hencky elasticity with von Mises perfect plasticity (Coombs 2023, eqs. 8 and 9).
#pragma once
#include "core/materials/hencky.hpp"

namespace gimpm {

class VonMises {
public:
	/// yieldStress > 0 [Pa] bounds rho = sqrt(2 J2) of the Kirchhoff stress.
	VonMises(double young, double poisson, double yieldStress) : elastic_(young, poisson), yield_(yieldStress) { }

	/// Relative. A point that was returned to the yield surface lies on it to round-off, which must not decide between the elastic and
	/// the plastic tangent with which its next step starts.
	static constexpr double yieldTolerance = 1e-9;

	static constexpr std::array<InternalVariable, 1> variables { equivalentPlasticStrain };
	static constexpr bool                            mayFail = false;

	std::array<double, 1> initialInternals() const { return { 0 }; }

	double young(const std::array<double, 1>&) const { return elastic_.young(); }

	/// Radial return: exact for perfect plasticity with an associated rule, because the deviator only shrinks.
	template <class T> ResponseWith<T, 1> respond(const PrincipalValues<T>& trialStrain, const std::array<T, 1>& internals) const
	{
		const double             G      = elastic_.shear();
		const T                  third  = T(1. / 3) * (trialStrain[0] + trialStrain[1] + trialStrain[2]);
		const PrincipalValues<T> dev    = trialStrain - PrincipalValues<T>::Constant(third);
		const T                  length = sqrt(dev[0] * dev[0] + dev[1] * dev[1] + dev[2] * dev[2]), rho = T(2 * G) * length;
		const auto               yields = rho > T(yield_ * (1 + yieldTolerance));
		const T                  theta  = select(yields, T(yield_) / rho, T(1)); // remaining share of the trial deviator
		PrincipalValues<T>       elasticStrain;
		for (int i = 0; i < 3; ++i)
			elasticStrain[i] = select(yields, theta * dev[i] + third, trialStrain[i]);
		ResponseWith<T, 1> r;
		r.take(elastic_.respond<T>(elasticStrain, {}));
		r.internals[0] = internals[0] + T(std::sqrt(2. / 3)) * (T(1) - theta) * length;

		const PrincipalValues<T> n     = dev * (T(1) / select(yields, length, T(1)));
		const T                  shear = T(G) * theta, lambda = T(elastic_.bulk()) - T(2. / 3) * shear, along = select(yields, T(-2) * shear, T(0));
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j < 3; ++j)
				r.tangent(i, j) = along * n[i] * n[j] + (i == j ? lambda + T(2) * shear : lambda);
		r.shear.fill(shear);
		return r;
	}
	ResponseWith<double, 1> respond(const Vec3& trialStrain, const std::array<double, 1>& internals) const { return respond<double>(trialStrain, internals); }

private:
	Hencky elastic_;
	double yield_;
};

} // namespace gimpm
