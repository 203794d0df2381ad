// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Faces of sand that stand in a run, and not by limit analysis.
#include "core/stepping/model.hpp"
#include "engine/points/MaterialPoints.hpp"

namespace yade {
class Analysis;

// After a static step: of a free, steep face whose soil weighs more than its strength bears; empty if there is none, or
// if more acts than gravity and held nodes.
template <int Dim> string warningOfSlip(const Analysis&, const vector<MaterialPoint>&, const gimpm::PointCloud<Dim>&, const gimpm::Model<Dim>&);

} // namespace yade
