// SPDX-License-Identifier: GPL-2.0-or-later
// The internal force with F-bar, compiled apart.
#pragma once
#include "core/terms/term.hpp"

namespace gimpm {

template <int Dim> struct Pass;
template <int Dim> std::optional<PointFailure> addFBarForce(const Pass<Dim>&);

} // namespace gimpm
