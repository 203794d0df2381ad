// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/flow/pointMass.hpp"
#include "core/materials/retention.hpp"

namespace yade {

PointMass pointMass(const shared_ptr<MpmFlow>& flow, const Vector3r& gravity)
{
	if (!flow || !flow->total) return massOfFull;
	constexpr Real onEarth = 9.81; // [m/s2]
	const Real     weight = flow->unitWeight, density = weight / (gravity.isZero(0) ? onEarth : gravity.norm());
	return [weight, density](const MaterialPoint& point) {
		const MpmState& state      = *point.state;
		const Real*     own        = state.parameter("porosity");
		const Real      porosity   = own ? *own : point.material->porosity;
		Real            saturation = state.saturation;
		if (std::isnan(saturation)) {
			const auto& curve = point.material->retention;
			saturation        = curve ? curve->law(weight).saturation(state.excessPressure).value : 1;
		}
		return massOfFull(point) + density * (saturation * (state.volume - (1 - porosity) * state.volume0) - porosity * state.volume0);
	};
}

} // namespace yade
