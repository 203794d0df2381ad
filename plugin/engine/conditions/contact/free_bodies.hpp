// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Limit of steps for bodies that YADE moves freely beside the soil.
#include "core/terms/contact/contact_system.hpp"
#include "yade_api/body.hpp"

namespace yade {

// The highest eigenvalue of M^-1 K of a body that moves by the inverse of its masses, blocked ones left out [1/s2].
Real frequency2(const State&, const gimpm::ContactLoad::Stiffness&);

// Soil of time steps where a body touches it.
struct SoilAtBody {
	Real density = 0, cellSize = 0; // [kg/m3], [m]
	bool answers = true;            // within the step to the force that it gets
};

// std::invalid_argument where a body that is handed over the force of a load step until the next one would gain energy
// by that. With the soil asked about where the body would be after the time T without it,
//     x_1 = x_0 + T v_0 + T^2 F / (2 m),  v_1 = v_0 + T F / m,  F = -k (x_0 + T v_0),
// the motion is damped and stable for k T^2 / m < 2, and half of that is admitted. k is that of the penalties in series
// with the soil: that of a rigid punch on a half-space, 2 E times its width, of which a cell is the least, and of the
// mass that moves with it within the step, 2 / T^2 times 0.3 of that in the first layer of cells.
void requirePeriod(const Body&, const gimpm::ContactLoad&, const SoilAtBody&, Real dt, Real period);

} // namespace yade
