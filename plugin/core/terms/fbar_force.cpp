// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/fbar_force.hpp"
#include "core/terms/point_pass.hpp"

namespace gimpm {

template <int Dim> std::optional<PointFailure> addFBarForce(const Pass<Dim>& pass) { return addPoints<FBarChunk<Dim>>(pass); }

template std::optional<PointFailure> addFBarForce(const Pass<2>&);
template std::optional<PointFailure> addFBarForce(const Pass<3>&);

} // namespace gimpm
