// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// What a contact remembers of a point that becomes two.
#include "engine/conditions/MpmContact.hpp"
#include <array>

namespace yade {

// A point whose domain is halved along an axis; its number stays with the lower half.
struct HalvedDomain {
	int                 lower, upper; // ids
	int                 axis, dim;
	std::array<Real, 3> middle, halfSize; // of the whole [m]
};

// The corners of the halves remember the forces of the corners of the whole, with the same sum, shared by the areas that they stand for. Where the halves meet, there are
// corners that the whole did not have.
void shareRecords(MpmContact&, const HalvedDomain&);

} // namespace yade
