// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/flow/MpmFlow.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/conditions/flow/flows.hpp"
#include "yade_api/registration.hpp"

namespace yade {

void MpmFlow::requireAdmissible() const
{
	Exposed<MpmFlow, MpmCondition>::requireAdmissible();
	for (size_t i = 0; i < drains.size(); ++i) {
		if (!drains[i]) throw std::invalid_argument("MpmFlow.drains[" + std::to_string(i) + "] is None: expected an MpmDrain.");
		drains[i]->requireAdmissible();
		for (size_t j = 0; j < i; ++j)
			if (drains[i] == drains[j])
				throw std::invalid_argument(
				        "MpmFlow.drains[" + std::to_string(j) + "] and [" + std::to_string(i)
				        + "] are the same MpmDrain, which would act twice: list it once.");
	}
}

shared_ptr<MpmFlow> MpmFlow::of(const Analysis& analysis)
{
	for (const Listed& listed : analysis.conditions())
		if (auto flow = boost::dynamic_pointer_cast<MpmFlow>(listed.condition)) return flow;
	return nullptr;
}

void MpmFlow::requireFitting(const Analysis& analysis, const string&) const
{
	string what;
	if (analysis.isExplicit()) what = analysis.className() + ".scheme = 'explicit'";
	else if (analysis.ghost->workTolerance < 1)
		what = "MpmGhost.workTolerance < 1, which knows of no work of water";
	else if (analysis.ghost->memory > 0)
		what = "MpmGhost.memory > 0, as soil through which water flows does not go on by the growth of the load";
	if (!what.empty()) throw std::invalid_argument("MpmFlow cannot yet go with " + what + "; leave one of the two out.");
	for (const auto& [of, tolerance] : { std::pair("pressureTolerance", pressureTolerance), std::pair("saturationTolerance", saturationTolerance) })
		if (std::isfinite(tolerance) && analysis.newton->stepTolerance == 0)
			throw std::invalid_argument(
			        string("MpmFlow.") + of + " = " + textOf(tolerance)
			        + " needs the error of displacements, and MpmNewton.stepTolerance = 0: give that, too, or leave " + of + " = inf.");
	if (std::isfinite(saturationTolerance) && !total)
		throw std::invalid_argument(
		        "MpmFlow.saturationTolerance = " + textOf(saturationTolerance) + " is for total = True: without it all pores are full; leave it inf.");
}

std::shared_ptr<Condition<2>> MpmFlow::make(InPlane, const Group& group, const Analysis&) const { return std::make_shared<Flows<2>>(group); }
std::shared_ptr<Condition<3>> MpmFlow::make(InSpace, const Group& group, const Analysis&) const { return std::make_shared<Flows<3>>(group); }

Real MpmFlow::end(const Analysis&) const
{
	Real last = -std::numeric_limits<Real>::infinity();
	for (const auto& drain : drains)
		for (const auto* curve : { &drain->curve, &drain->levels })
			if (!curve->empty()) last = std::max(last, gimpm::LoadCurve(*curve).end());
	return last;
}

std::map<string, string> MpmFlow::warnings(const Analysis&, const vector<MaterialPoint>& points, const string&) const
{
	constexpr Real           least = 1e-13, most = 1; // conductivities of soils: fat clay, and coarse gravel
	std::map<string, string> found;
	const MpmMaterial*       last = nullptr;
	for (const MaterialPoint& point : points) {
		if (point.material.get() == last) continue;
		last                 = point.material.get();
		const Real         k = last->conductivity.largest();
		std::ostringstream text;
		if (k > 0 && k < least)
			text << "material '" << last->label << "': conductivity = " << k
			     << " m/s is less than that of any soil. Is it a permeability [m2]? It would be " << k * unitWeight / 1e-3
			     << " m/s for water of a viscosity of 1e-3 Pa s.";
		if (k > most)
			text << "material '" << last->label << "': conductivity = " << k
			     << " m/s is more than that of any soil. Is it in m/day, which would be " << k / 86400 << " m/s?";
		if (!text.str().empty()) found["conductivity of " + last->label] = text.str();
	}
	return found;
}

void MpmFlow::tell(Rows& rows, const Analysis& analysis, const Listed&) const
{
	if (analysis.isDynamic()) rows.set("waterWork", work);
	rows.set("waterIn", waterIn);
	rows.set("waterOut", waterOut);
	rows.set("waterStored", waterStored);
	for (size_t i = 0; i < drains.size(); ++i)
		rows.set("drain" + std::to_string(i), drains[i]->discharge);
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmFlow)
static const yade::PluginClasses<yade::MpmFlow> registeredMpmFlow(__FILE__);
