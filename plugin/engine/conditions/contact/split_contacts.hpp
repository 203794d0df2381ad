// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// What a contact remembers of a point that becomes two.
#include "engine/conditions/contact/MpmContact.hpp"
#include <array>
#include <functional>

namespace yade {

// A place's distance from a body, < 0 inside [m], as seen from the middle of the whole; beside the edge of a sheet
// infinity.
struct KnownBody {
	int                                  id;
	std::function<Real(const Vector3r&)> distance;
};

// The corners of the halves remember the forces of the corners of the whole, with the same sum, shared by the areas
// that they stand for. Where the halves meet, there are corners that the whole did not have: a round body, or an edge,
// may have come between those of the whole by then, and is taken as fitting as far as these have not felt it.
void shareRecords(MpmContact&, const HalvedDomain&, const vector<KnownBody>&);

} // namespace yade
