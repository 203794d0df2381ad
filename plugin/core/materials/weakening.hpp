// SPDX-License-Identifier: GPL-2.0-or-later
// What strength reduction makes of the parameters of a law: strengths divided by one factor, and all moduli multiplied by another.
#pragma once
#include "core/materials/law.hpp"

namespace gimpm {

struct Weakening {
	double strength = 1; ///< factor of safety: c and tan(phi) are divided by it
	double moduli   = 1;
};

/// Without strength.
inline Hencky::Parameters weakened(const Hencky& law, const Weakening& w) { return { law.parameters()[0] * w.moduli }; }

inline VonMises::Parameters weakened(const VonMises& law, const Weakening& w)
{
	const auto [young, yield, hardening, residual] = law.parameters();
	return { young * w.moduli, yield / w.strength, hardening * w.moduli / w.strength, residual / w.strength };
}

/// Of Mohr and Coulomb's law and of cones that are matched to it; the soil cannot dilate more than it has friction.
template <class L> typename L::Parameters weakened(const L& law, const Weakening& w)
{
	const auto [young, cohesion, friction, dilation, tension] = law.parameters();
	const double angle                                        = w.strength == 1 ? friction : std::atan(std::tan(friction) / w.strength);
	return { young * w.moduli, cohesion / w.strength, angle, std::min(dilation, angle), tension / w.strength };
}

/// Its strength grows from its preconsolidation: there is no single strength to be divided.
inline CamClay::Parameters weakened(const CamClay& law, const Weakening&) { return law.parameters(); }

} // namespace gimpm
