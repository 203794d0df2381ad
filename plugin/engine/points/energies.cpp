// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/points/energies.hpp"
#include "core/parallel/together.hpp"
#include <algorithm>

namespace yade {

Energies energiesOf(const vector<MaterialPoint>& points, const PointMass& mass)
{
	Energies sum;
	for (const MaterialPoint& point : points) {
		const MpmState& state = *point.state;
		const Vector3r  p     = mass(point) * state.vel;
		sum.momentum += p;
		sum.angularMomentum += state.pos.cross(p);
		sum.kinetic += p.dot(state.vel) / 2;
		sum.elastic += elasticEnergy(point);
	}
	return sum;
}

bool isElasticEnergyKnown(const vector<MaterialPoint>& points)
{
	return std::all_of(points.begin(), points.end(), [](const MaterialPoint& point) { return point.material->hasHenckyElasticity(); });
}

Energies ofAll(const Energies& own, const gimpm::Processes& all)
{
	Real sums[] = { own.kinetic,           own.elastic, own.momentum[0], own.momentum[1], own.momentum[2], own.angularMomentum[0], own.angularMomentum[1],
		        own.angularMomentum[2] };
	gimpm::addUp(all, sums, int(std::size(sums)));
	return { sums[0], sums[1], Vector3r(sums[2], sums[3], sums[4]), Vector3r(sums[5], sums[6], sums[7]) };
}

} // namespace yade
