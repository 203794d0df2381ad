// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The law with cohesion and friction of a material, whose moduli go with a power of the pressure if the material says so.
#include "core/materials/power_elastic.hpp"
#include "engine/materials/MpmFrictionalMat.hpp"
#include "engine/materials/over_time.hpp"

namespace yade {

// make(Young's modulus, Poisson's ratio) is the law with Hencky's elasticity.
template <class Make> gimpm::Law frictionalLaw(const MpmFrictionalMat& m, Real viscosity, Make make)
{
	if (m.power == 0) return overTime(m, make(m.young, m.poisson), m.poisson, viscosity);
	const gimpm::PowerElastic::Moduli moduli { m.young, m.poisson, m.power, m.referencePressure };
	const gimpm::Hencky               secant = gimpm::PowerElastic::secant(moduli);
	return overTime(m, gimpm::PowerElastic(moduli, make(secant.young(), secant.poisson())));
}

// std::invalid_argument if another attribute, which is there, does not go with the power.
inline void requireWithoutPower(const MpmFrictionalMat& m, const char* other, Real value, const char* instead)
{
	if (m.power == 0) return;
	std::ostringstream text;
	text << m.getClassName() << ".power = " << m.power << " is not admitted with " << other << " = " << value << ": " << instead;
	throw std::invalid_argument(text.str());
}

} // namespace yade
