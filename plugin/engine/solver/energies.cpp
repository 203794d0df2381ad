// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/energies.hpp"
#include "core/parallel/together.hpp"
#include "engine/solver/MpmDynamicEngine.hpp"
#include "engine/solver/processes.hpp"

namespace yade {

Energies energiesOf(const vector<MaterialPoint>& points)
{
	Energies sum;
	for (const MaterialPoint& point : points) {
		const MpmState& state = *point.state;
		const Vector3r  p     = point.material->density * state.volume0 * state.vel;
		sum.momentum += p;
		sum.angularMomentum += state.pos.cross(p);
		sum.kinetic += p.dot(state.vel) / 2;
		sum.elastic += elasticEnergy(state);
	}
	return sum;
}

Energies ofAll(const Energies& own, const gimpm::Processes& all)
{
	Real sums[] = { own.kinetic,           own.elastic, own.momentum[0], own.momentum[1], own.momentum[2], own.angularMomentum[0], own.angularMomentum[1],
		        own.angularMomentum[2] };
	gimpm::addUp(all, sums, int(std::size(sums)));
	return { sums[0], sums[1], Vector3r(sums[2], sums[3], sums[4]), Vector3r(sums[5], sums[6], sums[7]) };
}

// The imbalance is what integration in time and the way of velocities to the grid and back have added.
void MpmDynamicEngine::tellMotion(py::dict& data) const
{
	const Energies own = energiesOf(materialPoints(*ownScene(), mask));
	const Energies now = ofAll(own, *holdersOf(*this));
	for (int axis = 0; axis < 3; ++axis) {
		if (axis < grid->dim) data[string("momentum_") + "xyz"[axis]] = now.momentum[axis];
		if (axis == 2 || grid->dim == 3) data[string("angularMomentum_") + "xyz"[axis]] = now.angularMomentum[axis];
	}
	for (size_t i = 0; i < absorbing.size(); ++i)
		for (int axis = 0; axis < grid->dim; ++axis)
			data["absorbing" + std::to_string(i) + "_" + "xyz"[axis]] = absorbing[i]->reaction[axis];
	data["kineticEnergy"] = now.kinetic;
	data["elasticEnergy"] = now.elastic;
	data["loadWork"]      = loadWork;
	data["boundaryWork"]  = boundaryWork;
	data["contactWork"]   = contactWork;
	data["impactWork"]    = impactWork;
	data["ghostWork"]     = ghostWork;
	data["gridWork"]      = gridWork;
	data["plasticWork"]   = plasticWork;
	data["dampingWork"]   = dampingWork;
	data["energyImbalance"]
	        = now.total() - firstEnergy - loadWork - boundaryWork - contactWork + impactWork + ghostWork + gridWork + plasticWork + dampingWork;
}

} // namespace yade
