// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// The law of a material, or where the material says so the law over time.
#include "core/materials/in_space.hpp"
#include "core/materials/relaxing.hpp"
#include "engine/materials/MpmMaterial.hpp"

namespace yade {

// Makes the law in time of a tensor law.
template <class L> gimpm::Law overTime(const MpmMaterial& material, const L& law)
{
	if (std::isnan(material.relaxationTime)) return law;
	return gimpm::Relaxing<L>(law, material.relaxationTime);
}

// Makes the law in time of a principal law; by a viscosity [Pa s], if that is not 0.
template <class L> gimpm::Law overTime(const MpmMaterial& material, const L& law, Real poisson, Real viscosity = 0)
{
	using InSpace = gimpm::InSpace<L>;
	if constexpr (L::isLinear)
		if (viscosity > 0) return gimpm::Relaxing<InSpace>::viscous(InSpace(law, poisson), viscosity);
	if (std::isnan(material.relaxationTime)) return law;
	return gimpm::Relaxing<InSpace>(InSpace(law, poisson), material.relaxationTime);
}

// std::invalid_argument if a material has both of the attributes that say the same.
inline void requireOneOfTimes(const MpmMaterial& material, Real viscosity)
{
	if (!(viscosity > 0) || std::isnan(material.relaxationTime)) return;
	std::ostringstream text;
	text << material.getClassName() << ": viscosity = " << viscosity << " Pa s and relaxationTime = " << material.relaxationTime
	     << " s both say how fast it flows; give one of them.";
	throw std::invalid_argument(text.str());
}

} // namespace yade
