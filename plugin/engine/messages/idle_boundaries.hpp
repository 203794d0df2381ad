// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/points/MaterialPoints.hpp"

namespace yade {
class MpmBoundary;
class MpmImplicitEngine;

// Of boundaries that do not reach any of the points, a sentence for each; empty if there is none. Some may be left out.
string idleBoundaries(const MpmImplicitEngine&, const vector<MaterialPoint>&, const vector<const MpmBoundary*>& except = {});

// The same of contacts: those of which no body has touched the points in the last converged step.
string idleContacts(const MpmImplicitEngine&);

} // namespace yade
