// SPDX-License-Identifier: GPL-2.0-or-later
// The internal force of bodies of revolution, compiled apart: the pass of plane strain with one gradient more, u_x / x around the axis.
#pragma once
#include "core/terms/term.hpp"

namespace gimpm {

template <int Dim> struct Pass;

/// With F-bar or without.
std::optional<PointFailure> addRingForce(const Pass<2>&);

} // namespace gimpm
