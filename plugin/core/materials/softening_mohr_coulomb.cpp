// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/materials/softening_mohr_coulomb.hpp"

namespace gimpm {

TensorAnswer SofteningMohrCoulomb::respond(const TensorStep& step) const
{
	return answerInPrincipalAxes(step, [&](const Vec3& strain, TensorState& state) -> Response {
		const double before = state.scalar(softening), grown = flow(strain, before);
		Response     r = at(strain, strengthStrain(before, grown));
		if (grown > 0) addHardening(strain, before, grown, r);
		state.scalar(plasticStrain) += grown;
		state.scalar(softening) += grown;
		return r;
	});
}

double SofteningMohrCoulomb::flow(const Vec3& strain, double before) const
{
	double low = 0, high = plasticAt(strain, strengthStrain(before, 0)), atLow = high;
	if (!(high > 0)) return 0;
	double       atHigh = plasticAt(strain, strengthStrain(before, high)) - high;
	const double exact  = 1e-14 * high + 4e-16 * strain.norm(); // below that there is round-off of the return
	for (int iteration = 0; iteration < 200 && high - low > exact && atHigh < 0; ++iteration) {
		const bool   bisects = iteration % 3 == 2;
		const double a       = bisects ? (low + high) / 2 : low + (high - low) * atLow / (atLow - atHigh),
		             f       = plasticAt(strain, strengthStrain(before, a)) - a;
		if (std::abs(f) <= exact) return a;
		(f > 0 ? low : high)     = a;
		(f > 0 ? atLow : atHigh) = f;
	}
	return high;
}

void SofteningMohrCoulomb::addHardening(const Vec3& strain, double before, double grown, Response& r) const
{
	const double   softening = strengthStrain(before, grown), rate = restoredBy(before, grown);
	const double   d     = 1e-4 * residual_.strain;
	const Response above = at(strain, softening + d), below = at(strain, softening - d);
	const Vec3     byStrength = (above.stress - below.stress) / (2 * d), flown = strain - r.elasticStrain, deviator = flown.array() - flown.mean();
	const double   ofStrength = (plasticAt(strain, softening + d) - plasticAt(strain, softening - d)) / (2 * d);
	Mat3           flows      = Mat3::Identity(); // d flown / d strain
	for (int j = 0; j < 3; ++j)
		flows.col(j) -= elasticity().strainOf<double>(Vec3(r.tangent.col(j)));
	const Vec3 direction = deviator / deviator.norm(), byStrain = std::sqrt(2. / 3) * (flows.transpose() * direction);
	r.tangent -= rate * byStrength * byStrain.transpose() / (1 + rate * ofStrength);
}

} // namespace gimpm
