// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/analysis/condition.hpp"
#include <functional>

namespace yade {
class Analysis;

// Sentences about conditions that constrain nothing now, as no point is near them or touches them; empty if there is
// none. Those may be chosen.
string idleConditions(const Analysis&, const vector<MaterialPoint>&, const std::function<bool(const MpmCondition&)>& isMeant);

} // namespace yade
