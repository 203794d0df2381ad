// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Other engines that move bodies of the scene.
#include "engine/points/MaterialPoints.hpp"
#include "yade_api/scene.hpp"

namespace yade {

// The NewtonIntegrators among O.engines.
class Movers {
public:
	// std::invalid_argument names one where it cannot be told from here what it does.
	explicit Movers(const Scene&);

	// True if one moves this body by its velocities. Members of a clump move with that.
	bool move(const Body&) const;

	// Refuses material points that one would move besides their own engine: in statics those that have a velocity.
	void requireOthers(const vector<MaterialPoint>&, const Scene&, bool isDynamic) const;

private:
	vector<int> masks;
};

// For a body that gets the forces of the soil. It is solved with positions of YADE's integrator, and its forces are for
// that.
void requireExchange(const Body&, const Scene&);

} // namespace yade
