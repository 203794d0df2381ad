// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Free bodies that roll on soil without inertia.
#include "core/terms/contact/contact_system.hpp"
#include "yade_api/scene.hpp"

namespace yade {

// Doubt about a Sphere or a clump, owner of this number, that YADE moves and on which soil acts in a static step: it
// rolls on few cells, and has turned by half a radian since it was made. Empty: there is none.
template <int Dim> string warningOfRolling(const Body&, const gimpm::ContactSystem<Dim>&, int owner, Real cellSize);

} // namespace yade
