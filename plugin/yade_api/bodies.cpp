// SPDX-License-Identifier: GPL-2.0-or-later
#include "yade_api/bodies.hpp"
#include "yade_api/python_lock.hpp"
#include <algorithm>

namespace yade {

void release(vector<shared_ptr<Body>> bodies, const Scene& scene)
{
	if (PyGILState_Check()) return;
	std::sort(bodies.begin(), bodies.end());
	bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
	const auto last = std::make_shared<vector<shared_ptr<Body>>>();
	{
		const BodiesLock lock(scene);
		for (auto& body : bodies)
			if (body.use_count() == 1) last->push_back(std::move(body));
		bodies.clear();
	}
	if (!last->empty()) withPython(Singleton<Omega>::instance().simulationLoop->looping, [last] { last->clear(); });
}

} // namespace yade
