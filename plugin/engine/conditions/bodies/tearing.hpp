// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Bodies of points that fall into parts, and bodies that come to stick to each other.
#include "engine/analysis/analysis.hpp"
#include "engine/points/MaterialPoints.hpp"
#include <set>

namespace yade {

// Gives parts of bodies that have a contact with themselves, and that no chain of neighbouring cells connects any more,
// bodies of their own in MpmGrid.bodies, with surfaces. Returns a doubt, a sentence; empty if there is none.
string tear(const Analysis&, const vector<MaterialPoint>&);

// True if there are such contacts.
bool mayTear(const Analysis&);

// Bodies without a contact that begin to share nodes.
class Sticking {
public:
	// True if there are bodies without a contact that have not shared nodes yet: then warning() is to be called.
	bool mayBegin(const Analysis&);
	// Names two bodies that have come to share nodes since the last call, a sentence; empty if there are none, and
	// in the first call.
	string warning(const Analysis&, const vector<MaterialPoint>&);

private:
	bool                          hasLooked = false;
	std::set<std::pair<int, int>> pairs, known; // to be looked at; those that have shared nodes
};

} // namespace yade
