// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/flow/pointMass.hpp"
#include "core/terms/water/unsaturated_point.hpp"
#include "engine/materials/parameters.hpp"
#include <optional>

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
			OwnMaterial  own;
			const auto&  curve = own.of(*point.material, state.parameters).retention;
			const auto   law   = curve ? std::optional(curve->law(weight)) : std::nullopt;
			gimpm::Pores pores;
			pores.porosity = porosity, pores.retention = law ? &*law : nullptr;
			saturation = gimpm::saturationOf(pores, state.excessPressure, state.volume / state.volume0).value;
		}
		return massOfFull(point) + density * (saturation * (state.volume - (1 - porosity) * state.volume0) - porosity * state.volume0);
	};
}

} // namespace yade
