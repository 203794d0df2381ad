// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Strengths and moduli of the material classes, and properties of their pores, that may differ from point to point.
#include "engine/materials/MpmMaterial.hpp"
#include <functional>
#include <string_view>

namespace yade {

struct Parameter {
	const char *name, *unit, *label; // name of the attribute; SI, "-" of a ratio; for pictures
};

// Each name once, in the order of mpm.arrays.
const vector<Parameter>& allParameters();
bool                     isParameter(std::string_view name);

// Parameter of a class of materials.
struct ParameterOfClass {
	const char*                        name;
	std::function<Real&(MpmMaterial&)> in;

	Real valueIn(const MpmMaterial& material) const { return in(const_cast<MpmMaterial&>(material)); }
};

// Parameters of flow through the pores, which materials of all classes may have.
const vector<ParameterOfClass>& parametersOfPores();

// Parameter of the material's class, or of its pores; null: there is none of this name.
const ParameterOfClass* findParameter(const MpmMaterial&, std::string_view name);

using OwnParameters = vector<std::pair<string, Real>>; // parameters of a point: name and value, each name once

// Materials as points have them, one point after the other.
class OwnMaterial {
public:
	// The material itself for a point without parameters of its own, else one that has them, until the next call.
	// std::invalid_argument as the material would give, or for a name that it does not have.
	const MpmMaterial& of(const MpmMaterial&, const OwnParameters&);

private:
	const MpmMaterial*      original = nullptr;
	shared_ptr<MpmMaterial> own;
};

} // namespace yade
