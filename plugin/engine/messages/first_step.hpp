// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Settings that are doubted before the first step of an engine.
#include "core/stepping/model.hpp"
#include "engine/points/MaterialPoints.hpp"
#include <map>

namespace yade {
class Analysis;

// Sentences by their subject; none where points are divided among processes, as none of them knows all points.
template <int Dim>
std::map<string, string> warningsOfFirstStep(const Analysis&, const vector<MaterialPoint>&, const gimpm::PointCloud<Dim>&, const gimpm::Model<Dim>&);

} // namespace yade
