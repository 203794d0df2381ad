// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Free bodies that the load step moves itself.
#include "core/grid/grid.hpp"
#include "core/terms/contact/contact_free.hpp"
#include "yade_api/scene.hpp"

namespace yade {

// Mass of a body, or a clump: in the plane per metre, around an axis of the body of revolution.
struct MassOfBody {
	Real     mass    = 0;                // [kg]
	Vector3r inertia = Vector3r::Zero(); // about its position along its own axes, in the plane along those of space, where the last counts [kg m2]
};

// From State.mass, which is that of bodies in space: a section has the mean density that they have.
// std::invalid_argument
// where that is not known.
template <int Dim> MassOfBody massOf(const Body&, const Scene&, const gimpm::Grid<Dim>&);

// Motion as the next step begins.
struct FreeMotion {
	Se3r       at;
	Vector3r   velocity, spin; // [m/s], [rad/s]
	MassOfBody mass;
	Vector3r   force, torque;  // loads from others than the soil, and weight [N], [N m]
	unsigned   given  = 0;     // bits of State.blockedDOFs: along these it goes by its velocity
	bool       inTime = false; // in seconds, with its inertia
	// In a step q = T ((1 - part) v_0 + part v_1): half, or more where the scheme takes out high frequencies.
	Real part = 0.5;

	// Pose after a time without the soil.
	Se3r ahead(Real time, const Vector3r& gravity) const;
};

// Free body of the core in a step of this duration.
template <int Dim> gimpm::FreeBody<Dim> freeBody(int owner, const FreeMotion&, Real duration, const Vector3r& gravity, bool isRing);

// After it.
template <int Dim> void follow(FreeMotion&, const gimpm::FreeBody<Dim>&, Real duration);

// std::invalid_argument where a body cannot be solved with the soil.
void requireSolvable(const Body&, const MassOfBody&, bool isMoved, bool inTime);

} // namespace yade
