// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/energies.hpp"
#include "engine/solver/MpmDynamicEngine.hpp"

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

// The imbalance is what integration in time and the way of velocities to the grid and back have added.
void MpmDynamicEngine::tellMotion(py::dict& data) const
{
	const Energies now = energiesOf(materialPoints(*const_cast<MpmDynamicEngine*>(this)->ownScene(), mask));
	for (int axis = 0; axis < 3; ++axis) {
		if (axis < grid->dim) data[string("momentum_") + "xyz"[axis]] = now.momentum[axis];
		if (axis == 2 || grid->dim == 3) data[string("angularMomentum_") + "xyz"[axis]] = now.angularMomentum[axis];
	}
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
