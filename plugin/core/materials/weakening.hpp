// SPDX-License-Identifier: GPL-2.0-or-later
// What strength reduction makes of the parameters of a law: strengths divided by one factor, and all moduli multiplied
// by another. A law with parameters that is not named here does not compile.
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

/// Young's modulus, cohesion, friction, dilation, tensile strength; the soil cannot dilate more than it has friction.
inline std::array<double, 5> weakenedFriction(const std::array<double, 5>& given, const Weakening& w)
{
	const auto [young, cohesion, friction, dilation, tension] = given;
	const double angle                                        = w.strength == 1 ? friction : std::atan(std::tan(friction) / w.strength);
	return { young * w.moduli, cohesion / w.strength, angle, std::min(dilation, angle), tension / w.strength };
}

inline MohrCoulomb::Parameters   weakened(const MohrCoulomb& law, const Weakening& w) { return weakenedFriction(law.parameters(), w); }
inline DruckerPrager::Parameters weakened(const DruckerPrager& law, const Weakening& w) { return weakenedFriction(law.parameters(), w); }

/// Its strength grows from its preconsolidation: there is no single strength to be divided.
inline CamClay::Parameters weakened(const CamClay& law, const Weakening&) { return law.parameters(); }

} // namespace gimpm
