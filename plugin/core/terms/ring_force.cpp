// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/terms/ring_force.hpp"
#include "core/terms/point_pass.hpp"

namespace gimpm {

std::optional<PointFailure> addRingForce(const Pass<2>& pass)
{
	return pass.points.hasFBar() ? addPoints<FBarChunk<2, 3>>(pass) : addPoints<Chunk<2, 3>>(pass);
}

} // namespace gimpm
