// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Material points whose domains have outgrown half a cell are split in two.
#include "engine/solver/job.hpp"

namespace yade {

struct Splits {
	int        made      = 0;
	int        left      = 0;  // points whose domain is kept at half a cell
	Body::id_t exhausted = -1; // the first of them that has been split as often as is admitted
};

// Between runs, at the end of one, of which the points of the job are those. Halves are split again until none has outgrown half a cell, or has been split so often.
// New bodies follow the others, in the scene and in the lists of points.
template <int Dim> Splits splitOutgrown(vector<MaterialPoint>&, Job<Dim>&, Scene&, int most);

} // namespace yade
