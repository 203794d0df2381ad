// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Bodies of points that fall into parts, and bodies that come to stick to each other.
#include "engine/analysis/analysis.hpp"
#include "engine/points/MaterialPoints.hpp"
#include <optional>
#include <set>

namespace yade {

// Gives parts of bodies that have a contact with themselves, and that no chain of neighbouring cells connects any more,
// bodies of their own in MpmGrid.bodies, with surfaces. Returns a doubt, a sentence; empty if there is none.
string tear(const Analysis&, const vector<MaterialPoint>&);

// Bodies without a contact that begin to share nodes.
class Sticking {
public:
	// Names the bodies that have come to share nodes since the last call, a sentence; empty if there are none, and
	// in the first call.
	string warning(const Analysis&, const vector<MaterialPoint>&);

private:
	std::optional<std::set<std::pair<int, int>>> known; // pairs that share nodes
};

} // namespace yade
