// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/scene.hpp"

namespace yade {

// Held while bodies are looked at in YADE's background thread, as a script may erase them meanwhile: O.bodies.erase()
// waits for it, and keeps Python's lock. So nothing that asks for Python's lock, and no erase(), may be called with it.
struct BodiesLock : std::lock_guard<std::mutex> {
	explicit BodiesLock(const Scene& scene) : lock_guard(scene.bodies->drawloopmutex) { }
};

// The body with this id, null where there is none, which stays whole when it is erased.
inline shared_ptr<Body> bodyAt(const Scene& scene, Body::id_t id)
{
	const BodiesLock lock(scene);
	return scene.bodies->exists(id) ? (*scene.bodies)[unsigned(id)] : nullptr;
}

// Lets go of bodies, also in YADE's background thread. Those that a script has erased meanwhile end here, and with
// them the objects of Python that they came from, for which Python's lock is needed.
void release(vector<shared_ptr<Body>>, const Scene&);

} // namespace yade
