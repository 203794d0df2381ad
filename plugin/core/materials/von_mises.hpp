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

	double young() const { return elastic_.young(); }

	/// Radial return: exact for perfect plasticity with an associated rule, because the deviator only shrinks.
	Response respond(const Vec3& trialStrain, double plasticStrain) const
	{
		const double G      = elastic_.shear();
		const double third  = trialStrain.sum() / 3;
		const Vec3   dev    = trialStrain.array() - third;
		const double length = dev.norm(), rho = 2 * G * length;
		if (rho <= yield_ * (1 + yieldTolerance)) return elastic_.respond(trialStrain, plasticStrain);
		const double theta = yield_ / rho; // remaining share of the trial deviator
		const Vec3   n     = dev / length;
		Response     r;
		r.elasticStrain = (theta * dev).array() + third;
		r.stress        = (2 * G * theta * dev).array() + 3 * elastic_.bulk() * third;
		r.tangent       = -2 * G * theta * n * n.transpose();
		r.tangent.array() += elastic_.bulk() - 2. / 3 * G * theta;
		r.tangent.diagonal().array() += 2 * G * theta;
		r.shear.setConstant(G * theta);
		r.plasticStrain = plasticStrain + std::sqrt(2. / 3) * (1 - theta) * length;
		return r;
	}

private:
	Hencky elastic_;
	double yield_;
};

} // namespace gimpm
