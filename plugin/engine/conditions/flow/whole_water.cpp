// SPDX-License-Identifier: GPL-2.0-or-later
// Water that has its weight, in pores that need not be full.
#include "engine/conditions/flow/flows.hpp"

namespace yade {

template <int Dim> void Flows<Dim>::beginWhole(const Surroundings<Dim>& around)
{
	for (const Listed& listed : around.analysis.conditions())
		if (const auto given = boost::dynamic_pointer_cast<MpmWater>(listed.condition); given && given->where != "outside")
			throw std::invalid_argument(
			        listed.name()
			        + " has a pressure in the pores, and flow.total = True finds all of it: leave the water out, or give it where = 'outside'.");
	auto&           whole   = water.whole.emplace();
	const Vector3r& gravity = around.analysis.gravity;
	whole.weight.setZero();
	if (!gravity.isZero(0)) whole.weight = from->unitWeight * gravity.normalized().template head<Dim>();
	if (from->bishop == "saturation") whole.bishop = gimpm::Bishop::saturation;
}

// Null: the pores of the point are always full.
template <int Dim> const gimpm::Retention* Flows<Dim>::curveOf(const MaterialPoint& point)
{
	const MpmMaterial& material = *point.material;
	const auto         refuse   = [&](const string& what) {
                throw std::invalid_argument("Body #" + std::to_string(point.id) + ": its material '" + material.label + "' " + what);
	};
	if (from->total && (material.isDugOut || material.share != 1))
		refuse("is placed or dug out step by step (mpm.stages), which does not yet go with flow.total = True.");
	if (!material.retention) return nullptr;
	if (!from->total) refuse("has a retention curve, which needs MpmFlow(total=True): then excessPressure is the whole pressure of the water.");
	const gimpm::Retention*& curve = curves[material.retention.get()];
	if (!curve) {
		water.whole->curves.push_back(std::make_shared<gimpm::Retention>(material.retention->law(from->unitWeight)));
		curve = water.whole->curves.back().get();
	}
	return curve;
}

#define MPM_INSTANTIATE(Dim)                                                                                                                                   \
	template void                    Flows<Dim>::beginWhole(const Surroundings<Dim>&);                                                                     \
	template const gimpm::Retention* Flows<Dim>::curveOf(const MaterialPoint&);
MPM_INSTANTIATE(2)
MPM_INSTANTIATE(3)
#undef MPM_INSTANTIATE

} // namespace yade
