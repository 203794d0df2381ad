// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Material points on their way to another process.
#include "engine/points/MaterialPoints.hpp"

namespace yade {

// Bodies with these ids, as numbers that can be sent: all that there is of them but the material, of which the place in
// O.materials goes with them.
vector<double> packBodies(const Scene&, const vector<Body::id_t>&);

// Puts them into a scene with the same materials, under their ids, which must be free there.
void unpackBodies(const vector<double>&, Scene&);

} // namespace yade
