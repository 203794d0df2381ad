// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The material points among the bodies of a scene.
#include "engine/MpmMaterial.hpp"
#include "engine/MpmPoint.hpp"
#include "engine/MpmState.hpp"

namespace yade {

struct MaterialPoint {
	const Body*  body;
	MpmPoint*    shape;
	MpmState*    state;
	MpmMaterial* material;

	// std::invalid_argument unless all its values can be computed with in this dimension (2 or 3). Its material is not looked at.
	void requireAdmissible(int dim) const;
};

// All bodies with an MpmPoint shape, in order of body id; valid until the scene changes. std::invalid_argument if one of them is
// incomplete, is left to YADE's collider or integrator, or if another body has a material that is for material points only.
vector<MaterialPoint> materialPoints(const Scene&);

} // namespace yade
