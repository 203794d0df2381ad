// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/parallel/processes.hpp"
#include "engine/points/MaterialPoints.hpp"
#include <functional>

namespace yade {

// Energies of material points.
struct Energies {
	Real     kinetic = 0, elastic = 0;           // [J]
	Vector3r momentum        = Vector3r::Zero(); // [kg m/s]
	Vector3r angularMomentum = Vector3r::Zero(); // about the origin [kg m2/s]

	Real total() const { return kinetic + elastic; }
};

using PointMass = std::function<Real(const MaterialPoint&)>; // [kg]

// Mass of a point with pores that are as full as the density of its material says.
inline Real massOfFull(const MaterialPoint& point) { return point.material->density * point.state->volume0; }

Energies energiesOf(const vector<MaterialPoint>&, const PointMass& = massOfFull);

// True if the elasticity of all points is Hencky's, whose energy elasticEnergy is.
bool isElasticEnergyKnown(const vector<MaterialPoint>&);

// From those of the points of each process.
Energies ofAll(const Energies&, const gimpm::Processes&);

// Half Kirchhoff stress times elastic strain over the initial volume: the energy of linear (Hencky) elasticity [J].
// Water that cannot leave the pores has its own.
inline Real elasticEnergy(const MaterialPoint& point)
{
	const MpmState& state  = *point.state;
	const Real      ofSoil = 0.5 * state.volume * state.stress.cwiseProduct(state.elasticStrain).sum();
	if (!point.material->undrained) return ofSoil;
	return ofSoil + std::pow(state.volume * state.excessPressure, 2) / (2 * state.volume0 * point.material->waterModulus);
}

} // namespace yade
