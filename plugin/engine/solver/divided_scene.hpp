// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/solver/distribution.hpp"

namespace yade {

// The scene of which this process has its own points, known also where the engine that has divided them has been taken out of O.engines.
struct DividedScene {
	boost::weak_ptr<Factorable> scene;
	Pieces                      pieces;
	Body::id_t                  gap = 0; // of a point of another process

	DividedScene() = default;
	DividedScene(Scene& whole, const Pieces& pieces) : scene(whole.weak_from_this()), pieces(pieces)
	{
		while (gap < pieces.bodies && (*whole.bodies)[gap])
			++gap;
	}

	// Not if all bodies have been taken out since, or given anew.
	bool is(const Scene* other) const
	{
		const auto known = boost::dynamic_pointer_cast<Scene>(scene.lock());
		return known && known.get() == other && int(known->bodies->size()) >= pieces.bodies && !(gap < pieces.bodies && (*known->bodies)[gap]);
	}

	// Of this process.
	static DividedScene& last()
	{
		static DividedScene only;
		return only;
	}
};

} // namespace yade
