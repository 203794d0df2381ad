// SPDX-License-Identifier: GPL-2.0-or-later
// Part of a contact in the balance of momentum and energy.
#pragma once
#include "core/terms/step_kind.hpp"

namespace gimpm {

struct ContactEnergy {
	StepKind kind   = StepKind::quasiStatic;
	double   weight = 1; ///< weight of its forces in the balance of a time step (core/terms/inertia/time_scheme.hpp)
	double   energy = 0; ///< energy that has come into the system before this time step [J]
	double   work   = 0; ///< on the soil in the last step that was accepted, with the forces at its end [J]
	/// Work in that step beyond what contact had stored, which is that of no body [J].
	double energyGain = 0;
	double friction   = 0; ///< energy that friction with rigid bodies has dissipated in that step [J]
	double penalties  = 0; ///< energy that their springs have taken in it, and not given back [J]
};

} // namespace gimpm
