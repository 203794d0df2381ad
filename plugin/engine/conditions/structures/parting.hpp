// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/types.hpp"

namespace yade {
class Analysis;

// Feature that nodes with affine constraints, as those beside a line that parts the soil, have not been shown to go
// with; empty: none.
string obstacleToParting(const Analysis&);

} // namespace yade
