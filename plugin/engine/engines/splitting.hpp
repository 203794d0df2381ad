// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Material points whose domains have outgrown half a cell are split in two.
#include "engine/engines/job.hpp"

namespace yade {

class MpmImplicitEngine;

class Splitting {
public:
	// At the end of a run, of which the points of the job are those. Halves are split again until none has outgrown
	// half a cell, or has been split maxSplits times; the engine's clampedDomains is the number of those that are
	// left. New bodies follow the others, in the scene and in the lists of points. Returns a sentence for the log,
	// empty if there is nothing to say.
	template <int Dim> string split(MpmImplicitEngine&, vector<MaterialPoint>&, Job<Dim>&);

private:
	bool isSaid = false; // true once the user was told that a point has been split as often as is admitted
};

} // namespace yade
