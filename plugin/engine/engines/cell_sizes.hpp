// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/analysis/analysis.hpp"

namespace yade {

// Functions of MpmAdaptation.where answer before a step, and before anything is taken over from the scene. The lock of
// values must not be held. std::invalid_argument for what they return or raise.
void askSizes(const Analysis&, const Scene&, int mask);

} // namespace yade
