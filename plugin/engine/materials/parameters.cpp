// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/parameters.hpp"
#include "engine/materials/laws.hpp"
#include "engine/materials/retention/curveParameters.hpp"
#include <algorithm>
#include <array>

namespace yade {

const vector<Parameter>& allParameters()
{
	static const vector<Parameter> all {
		{ "young", "Pa", "Young's modulus" },
		{ "shearModulus", "Pa", "shear modulus" },
		{ "E50ref", "Pa", "secant modulus" },
		{ "Eoedref", "Pa", "oedometer modulus" },
		{ "Eurref", "Pa", "modulus of unloading" },
		{ "yieldStress", "Pa", "yield stress" },
		{ "hardening", "Pa", "hardening" },
		{ "residualYieldStress", "Pa", "residual yield stress" },
		{ "undrainedStrength", "Pa", "undrained strength" },
		{ "cohesion", "Pa", "cohesion" },
		{ "frictionAngle", "rad", "friction angle" },
		{ "dilationAngle", "rad", "dilation angle" },
		{ "tensileStrength", "Pa", "tensile strength" },
		{ "criticalStateRatio", "-", "critical state ratio" },
		{ "conductivity", "m/s", "hydraulic conductivity" },
		{ "verticalConductivity", "m/s", "vertical hydraulic conductivity" },
		{ "porosity", "-", "porosity" },
		{ "alpha", "1/m", "inverse of a head of suction" },
		{ "entry", "m", "head of suction at which air enters" },
		{ "n", "-", "exponent of the retention curve" },
		{ "exponent", "-", "exponent of the retention curve" },
		{ "residual", "-", "residual degree of saturation" },
		{ "saturated", "-", "largest degree of saturation" },
	};
	return all;
}

const vector<ParameterOfClass>& parametersOfPores()
{
	static const vector<ParameterOfClass> all {
		{ "conductivity", [](MpmMaterial& m) -> Real& { return m.conductivity.horizontal; } },
		{ "verticalConductivity", [](MpmMaterial& m) -> Real& { return m.conductivity.vertical; } },
		{ "porosity", [](MpmMaterial& m) -> Real& { return m.porosity; } },
	};
	return all;
}

static std::array<const vector<ParameterOfClass>*, 3> allOf(const MpmMaterial& material)
{
	return { &parametersOf(material), &parametersOfPores(), &parametersOfCurve(material) };
}

const ParameterOfClass* findParameter(const MpmMaterial& material, std::string_view name)
{
	for (const auto* known : allOf(material))
		for (const ParameterOfClass& p : *known)
			if (p.name == name) return &p;
	return nullptr;
}

bool isParameter(std::string_view name)
{
	const auto& all = allParameters();
	return std::any_of(all.begin(), all.end(), [&](const Parameter& p) { return p.name == name; });
}

namespace {
	[[noreturn]] void refuseName(const string& name, const MpmMaterial& material)
	{
		string names;
		for (const auto* known : allOf(material))
			for (const ParameterOfClass& p : *known)
				names += (names.empty() ? "" : ", ") + string(p.name);
		throw std::invalid_argument(
		        "the material '" + material.label + "' (" + material.getClassName() + ") has no parameter " + name
		        + " that a point could have: there are " + names + ". Give the ids of the points that are meant.");
	}
}

const MpmMaterial& OwnMaterial::of(const MpmMaterial& material, const OwnParameters& parameters)
{
	if (parameters.empty()) return material;
	if (original != &material) {
		own = copyOf(material);
		renewCurve(*own);
	}
	original = &material;
	for (const auto* known : allOf(material))
		for (const ParameterOfClass& p : *known)
			p.in(*own) = p.valueIn(material);
	for (const auto& [name, value] : parameters) {
		const ParameterOfClass* found = findParameter(material, name);
		if (!found) refuseName(name, material);
		found->in(*own) = value;
	}
	own->requireAdmissible();
	return *own;
}

} // namespace yade
