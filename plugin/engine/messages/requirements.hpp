// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Requirements of a load step. std::invalid_argument otherwise.
#include "engine/points/MaterialPoints.hpp"

namespace yade {
class Analysis;

// A thread that may make one; std::runtime_error while the scene runs in another.
void requireCallable(const string& engine);

// Settings that are admitted, and go with each other: of runs and studies alike.
void requireSettings(const Analysis&);

// The clock and the other engines.
void requireRunnable(const Analysis&);

// O.time that counts seconds, where the law of a material depends on it.
void requireSeconds(const Analysis&, const vector<MaterialPoint>&);

// Material points that the engine is to move.
void requireAny(const vector<MaterialPoint>&, const Analysis&);

} // namespace yade
