// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Bodies of points that share nodes past a thin body between them.
#include "core/stepping/model.hpp"
#include "engine/analysis/analysis.hpp"

namespace yade {

// std::invalid_argument for two bodies without a contact that share nodes as a third, which has a contact with each, is
// thinner than the functions of these reach: their weight would go past it. Bodies that were filled side by side stick
// and are admitted. *layers*: of bodyLayers.
template <int Dim> void requireNonePast(const vector<MaterialPoint>&, const gimpm::Model<Dim>&, const Analysis&, const vector<int>& layers);

} // namespace yade
