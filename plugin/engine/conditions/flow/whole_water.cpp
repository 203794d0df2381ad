// SPDX-License-Identifier: GPL-2.0-or-later
// Water that has its weight, in pores that need not be full.
#include "core/terms/water/frozen_pressures.hpp"
#include "core/terms/water/unsaturated_point.hpp"
#include "engine/conditions/flow/flows.hpp"
#include "engine/conditions/flow/poreWater.hpp"
#include "engine/materials/retention/curveParameters.hpp"

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
	whole.bishop = bishopOf(*from);
	for (const auto& material : around.scene.materials) // in the same order in all processes
		if (const auto* soil = dynamic_cast<const MpmMaterial*>(material.get()); soil && soil->retention) curveOf(*soil->retention);
	if (around.analysis.newton->stepTolerance > 0) whole.saturationTolerance = from->saturationTolerance;
}

template <int Dim> int Flows<Dim>::curveOf(const MpmRetention& retention)
{
	const auto [found, isNew] = curves.emplace(&retention, int(curves.size()));
	if (isNew) water.whole->curves.push_back(std::make_shared<gimpm::Retention>(retention.law(from->unitWeight)));
	return found->second;
}

// None: the pores of the point are always full. The material `asPoint` has what is the point's own.
template <int Dim> void Flows<Dim>::takeCurve(const MaterialPoint& point, const MpmMaterial& asPoint, gimpm::Pores& pores)
{
	const MpmMaterial& material = *point.material;
	if (!material.retention) return;
	if (!from->total)
		throw std::invalid_argument(
		        "Body #" + std::to_string(point.id) + ": its material '" + material.label
		        + "' has a retention curve, which needs MpmFlow(total=True): then excessPressure is the whole pressure of the water.");
	pores.curve     = curveOf(*material.retention);
	pores.retention = water.whole->curves[pores.curve].get();
	if (!hasOwnCurve(material, point.state->parameters)) return;
	const gimpm::Retention own = asPoint.retention->law(from->unitWeight);
	pores.hasOwnCurve          = true;
	pores.ownCurve             = { own.alpha, own.exponent, own.residual, own.saturated };
	pores.retention            = &water.whole->ownCurves.emplace_back(own);
}

// Points that join others bring the water of their pressure. Where all are new, that of the nodes counts.
template <int Dim> void Flows<Dim>::fillNewPoints(const gimpm::PointCloud<Dim>& cloud, const gimpm::Division& division)
{
	auto& known = water.whole->saturation;
	if (division.sum(std::all_of(known.begin(), known.end(), [](Real value) { return std::isnan(value); }) ? 0 : 1) == 0) return;
	for (size_t p = 0; p < known.size(); ++p)
		if (std::isnan(known[p]))
			known[p] = gimpm::saturationOf(
			                   water.ownPores.empty() ? water.pores[cloud.material[p]] : water.ownPores[p], water.pressure[p], cloud.volumeRatio(p))
			                   .value;
}

// Keeps suction and water in a study as they are.
template <int Dim> std::unique_ptr<gimpm::Term<Dim>> Flows<Dim>::frozen(const gimpm::StepContext<Dim>& step) const
{
	vector<Real>            pushes;
	vector<gimpm::Vec<Dim>> weights;
	for (size_t p = 0; p < water.pressure.size(); ++p) {
		const gimpm::Pores& pores = water.ownPores.empty() ? water.pores[step.cloud.material[p]] : water.ownPores[p];
		if (!water.whole) {
			pushes.push_back(pores.coupling() * water.pressure[p]);
			continue;
		}
		const Real known = water.whole->saturation[p], J = step.cloud.volumeRatio(p), full = J - 1 + pores.porosity;
		const Real S = std::isnan(known) ? gimpm::saturationOf(pores, water.pressure[p], J).value : known;
		pushes.push_back(pores.coupling() * gimpm::pressureOnGrains(pores, water.whole->bishop, water.pressure[p], J).value);
		weights.push_back(pores.weightPart * step.cloud.volume0[p] * (S * full - pores.porosity) * water.whole->factor * water.whole->weight);
	}
	return std::make_unique<gimpm::FrozenPressures<Dim>>(pushes, step, weights);
}

#define MPM_INSTANTIATE(Dim)                                                                                                                                   \
	template std::unique_ptr<gimpm::Term<Dim>> Flows<Dim>::frozen(const gimpm::StepContext<Dim>&) const;                                                   \
	template void                              Flows<Dim>::beginWhole(const Surroundings<Dim>&);                                                           \
	template void                              Flows<Dim>::fillNewPoints(const gimpm::PointCloud<Dim>&, const gimpm::Division&);                           \
	template void                              Flows<Dim>::takeCurve(const MaterialPoint&, const MpmMaterial&, gimpm::Pores&);
MPM_INSTANTIATE(2)
MPM_INSTANTIATE(3)
#undef MPM_INSTANTIATE

} // namespace yade
