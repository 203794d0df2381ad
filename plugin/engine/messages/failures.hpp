// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// What is said of a load step that has failed: what went wrong, where, and what may help.
#include "core/stepping/report.hpp"
#include "engine/points/MaterialPoints.hpp"

namespace yade {
class Analysis;

const char* nameOf(gimpm::Failure);
const char* nameOf(gimpm::Definiteness);

// Of a step up to a time [s] that tried a part of O.dt and was given up.
string reasonOf(const gimpm::StepReport&, const Analysis&, const vector<MaterialPoint>&, Real time, Real part);

string warningOfAccepted(const gimpm::StepReport&, const Analysis&, Real time);

// Of static steps of the last run: that the stabilisation carries much, and that points are held where they are.
// Empty if it is not so.
string warningOfShare(const Analysis&);
string warningOfLoosePoints(const Analysis&);
string warningOfNoUnknowns(const Analysis&);

} // namespace yade
