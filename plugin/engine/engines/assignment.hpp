// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Data from NumPy arrays into the material points of the scene.
#include "yade_api/yade_api.hpp"

namespace yade {

// Gives the material points with these body ids (N int64) the values of some of those columns that can be set (N rows
// of double). What depends on these values follows: volume and halfSize, and of stress and elasticStrain the one that
// is not given. std::invalid_argument if a value is not admissible; then none is taken. Processes that have divided the
// points call it with the same, and each takes what its own points are given.
void assignColumns(const py::object& ids, const py::dict& columns);

} // namespace yade
