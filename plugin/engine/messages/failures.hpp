// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Message about a load step that has failed: cause, position, and remedy.
#include "core/stepping/report.hpp"
#include "engine/points/MaterialPoints.hpp"

namespace yade {
class Analysis;

const char* nameOf(gimpm::Failure);
const char* nameOf(gimpm::Definiteness);

// Message about a step up to a time [s] that tried a part of O.dt and was given up.
string reasonOf(const gimpm::StepReport&, const Analysis&, const vector<MaterialPoint>&, Real time, Real part);

string warningOfAccepted(const gimpm::StepReport&, const Analysis&, Real time);

// Warnings about static steps of the last run: the stabilisation carries much, and points are constrained where they
// are. Empty if it is not so.
string warningOfShare(const Analysis&);
string warningOfLoosePoints(const Analysis&);
string warningOfNoUnknowns(const Analysis&);

} // namespace yade
