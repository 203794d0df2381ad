// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Material points of a scene that this process has, where several have divided them.
#include "core/parallel/processes.hpp"
#include "yade_api/scene.hpp"

namespace yade {

// In a tag of the scene, so that it is saved, and known to whatever engine works on the points.
struct Pieces {
	int count = 0, number = 0; // number of processes, and of this one; none: it has all points
	int bodies = 0;            // numbers in O.bodies. Bodies behind have been added since, by each process
	int gap    = 0;            // the first place of another process, or `bodies`

	// None also where there are other bodies than those that were divided.
	static Pieces of(const Scene&);

	// Notes that the scene is divided among these processes now; for one alone that it is not.
	static void note(Scene&, const gimpm::Processes&);
};

// So that the list of bodies is as long in all processes, also where others have the last ones.
void provideGaps(Scene&, size_t places);

} // namespace yade
