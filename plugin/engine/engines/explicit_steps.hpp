// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Parts of MpmDynamicEngine for scheme='explicit' alone.
#include "engine/engines/job.hpp"
#include "yade_api/exposed.hpp"

namespace yade {
class MpmDynamicEngine;

// Settings that explicit steps can be made with, or std::invalid_argument, which names the one that does not go with
// them.
void requireExplicit(const MpmDynamicEngine&);

// A step of this duration [s] is stable, or std::invalid_argument with the limit.
template <int Dim> void requireStable(const MpmDynamicEngine&, const Setup<Dim>&, Real duration);

// Critical time step of the present state of the scene [s]; NaN without grid or points.
Real criticalTimeStep(MpmDynamicEngine&);

// Speed of the fastest pressure wave, there [m/s]; NaN without grid or points.
Real waveSpeed(MpmDynamicEngine&);

template <class C> void addExplicitSteps(C& c)
{
	c.def("criticalTimeStep", &criticalTimeStep,
	      "criticalTimeStep() -> float\n\nLargest stable O.dt [s] of scheme='explicit' in the present state, estimated on the safe side; NaN without points. Take 0.9 of it.");
	c.def("waveSpeed", &waveSpeed,
	      "waveSpeed() -> float\n\nSpeed of the fastest pressure wave in the present state [m/s], sqrt((K + 4 G / 3) / density) within yield surfaces; NaN without points.");
}

} // namespace yade
