// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Settings of an engine as those of the core.
#include "engine/analysis/condition.hpp"

namespace yade {

// Settings of an analysis as a model of the core, with the nodes that its conditions constrain; without points, terms.
template <int Dim> gimpm::Model<Dim> emptyModel(const Analysis&, const Conditions<Dim>&);

} // namespace yade
