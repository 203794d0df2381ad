// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/retention/curveParameters.hpp"
#include <algorithm>

namespace yade {

namespace {
	template <class C> ParameterOfClass ofCurve(const char* name, Real C::*member)
	{
		return { name, [member](MpmMaterial& material) -> Real& { return static_cast<C&>(*material.retention).*member; } };
	}
	vector<ParameterOfClass> withLimits(vector<ParameterOfClass> own)
	{
		own.push_back(ofCurve("residual", &MpmRetention::residual));
		own.push_back(ofCurve("saturated", &MpmRetention::saturated));
		return own;
	}
	template <class C> bool renewAs(shared_ptr<MpmRetention>& curve)
	{
		const auto known = boost::dynamic_pointer_cast<C>(curve);
		if (known) curve = shared_ptr<MpmRetention>(new C(*known));
		return bool(known);
	}
}

const vector<ParameterOfClass>& parametersOfCurve(const MpmMaterial& material)
{
	static const vector<ParameterOfClass> none,
	        vanGenuchten            = withLimits({ ofCurve("alpha", &MpmVanGenuchten::alpha), ofCurve("n", &MpmVanGenuchten::n) }),
	        gardner                 = withLimits({ ofCurve("alpha", &MpmGardner::alpha) }),
	        brooksCorey             = withLimits({ ofCurve("entry", &MpmBrooksCorey::entry), ofCurve("exponent", &MpmBrooksCorey::exponent) });
	const MpmRetention* const curve = material.retention.get();
	if (dynamic_cast<const MpmVanGenuchten*>(curve)) return vanGenuchten;
	if (dynamic_cast<const MpmGardner*>(curve)) return gardner;
	return dynamic_cast<const MpmBrooksCorey*>(curve) ? brooksCorey : none;
}

void renewCurve(MpmMaterial& material)
{
	auto& curve = material.retention;
	renewAs<MpmVanGenuchten>(curve) || renewAs<MpmGardner>(curve) || renewAs<MpmBrooksCorey>(curve);
}

bool hasOwnCurve(const MpmMaterial& material, const OwnParameters& parameters)
{
	const auto& known = parametersOfCurve(material);
	return std::any_of(known.begin(), known.end(), [&](const ParameterOfClass& p) {
		return std::any_of(parameters.begin(), parameters.end(), [&](const auto& own) { return own.first == p.name; });
	});
}

} // namespace yade
