// SPDX-License-Identifier: GPL-2.0-or-later
// Hencky elasticity: Kirchhoff stress linear in the logarithmic strain.
#pragma once
#include "core/materials/response.hpp"

namespace gimpm {

class Hencky {
public:
	/// young > 0 [Pa], -1 < poisson < 0.5.
	Hencky(double young, double poisson) : young_(young), bulk_(young / (3 * (1 - 2 * poisson))), shear_(young / (2 * (1 + poisson))) { }

	double young() const { return young_; }
	double bulk() const { return bulk_; }
	double shear() const { return shear_; }

	Response respond(const Vec3& trialStrain, double plasticStrain) const
	{
		Response r;
		const double volumetric = trialStrain.sum();
		r.stress                = (2 * shear_ * trialStrain).array() + (bulk_ - 2. / 3 * shear_) * volumetric;
		r.tangent.setConstant(bulk_ - 2. / 3 * shear_);
		r.tangent.diagonal().array() += 2 * shear_;
		r.shear.setConstant(shear_);
		r.elasticStrain = trialStrain;
		r.plasticStrain = plasticStrain;
		return r;
	}

private:
	double young_, bulk_, shear_;
};

} // namespace gimpm
