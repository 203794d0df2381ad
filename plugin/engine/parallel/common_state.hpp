// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// State that processes that divide the material points of a scene must have in common. std::runtime_error, in all
// of them, where they have not.
#include "core/parallel/processes.hpp"
#include "engine/points/MaterialPoints.hpp"

namespace yade {
class Analysis;
class NewPoints;

// The number of bodies, the points from the one at `begin` on, which each of them has, and the settings of the engine.
void requireSame(const gimpm::Processes&, const Analysis&, const vector<MaterialPoint>&, size_t begin);

void requireSame(const gimpm::Processes&, const NewPoints&);

// Compares the answers of functions of conditions, once each of them has been asked.
void requireSameAnswers(const gimpm::Processes&, const Analysis&);

// The materials that any of them has points of, in the order of O.materials; with the same values.
vector<const MpmMaterial*> materialsOfAll(const Scene&, const vector<MaterialPoint>&, const gimpm::Processes&);

} // namespace yade
