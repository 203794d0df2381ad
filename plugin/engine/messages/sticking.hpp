// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Bodies of points that come to stick to each other.
#include "engine/analysis/analysis.hpp"
#include "engine/points/MaterialPoints.hpp"
#include <set>

namespace yade {

// Bodies without a contact that begin to share nodes.
class Sticking {
public:
	// True if there are some that have not shared nodes yet: then warning() is to be called.
	bool mayBegin(const Analysis&);
	// Names two of them that have come to share nodes since the last call, a sentence; empty if there are none, and
	// in the first call.
	string warning(const Analysis&, const vector<MaterialPoint>&);

private:
	bool                          hasLooked = false;
	std::set<std::pair<int, int>> pairs, known; // to be looked at; those that have shared nodes
};

} // namespace yade
