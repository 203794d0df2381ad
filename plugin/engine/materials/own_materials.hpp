// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Materials of the core as points have them.
#include "engine/materials/laws.hpp"
#include <optional>
#include <unordered_map>

namespace yade {

// One for all points that have no parameters of their own.
class OwnMaterials {
public:
	// Valid until the next call.
	const gimpm::Material& of(const MpmMaterial& material, const OwnParameters& parameters)
	{
		if (parameters.empty()) {
			const auto found = shared.find(&material);
			return (found != shared.end() ? found : shared.emplace(&material, coreMaterial(material)).first)->second;
		}
		last.emplace(coreMaterial(ownMaterial.of(material, parameters)));
		return *last;
	}

private:
	std::unordered_map<const MpmMaterial*, gimpm::Material> shared;
	OwnMaterial                                             ownMaterial;
	std::optional<gimpm::Material>                          last;
};

} // namespace yade
