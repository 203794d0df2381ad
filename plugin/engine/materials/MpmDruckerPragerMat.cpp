// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmDruckerPragerMat.hpp"
#include "core/materials/law.hpp"
#include "engine/materials/law_of_class.hpp"
#include "engine/materials/over_time.hpp"
#include "yade_api/registration.hpp"

namespace yade {

void MpmDruckerPragerMat::requireAdmissible() const
{
	ExposedIndexed<MpmDruckerPragerMat, MpmFrictionalMat>::requireAdmissible();
	requireOneOfTimes(*this, viscosity);
	if (viscosity > 0) requireWithoutPower("viscosity", viscosity, "give relaxationTime = viscosity / modulus instead, or moduli that stay.");
}

static const RegisteredLaw<MpmDruckerPragerMat> lawOfMpmDruckerPragerMat(
        [](const MpmDruckerPragerMat& m) -> gimpm::Law {
	        using Cone       = gimpm::DruckerPragerCone;
	        const auto match = m.match == "compression" ? Cone::compression : m.match == "extension" ? Cone::extension : Cone::planeStrain;
	        return m.law(m.viscosity, [&](Real young, Real poisson) {
		        return gimpm::DruckerPrager(young, poisson, match(m.cohesion, m.frictionAngle, m.dilationAngle), m.tensileStrength);
	        });
        },
        std::pair("young", &MpmElasticMat::young), std::pair("cohesion", &MpmFrictionalMat::cohesion),
        std::pair("frictionAngle", &MpmFrictionalMat::frictionAngle), std::pair("dilationAngle", &MpmFrictionalMat::dilationAngle),
        std::pair("tensileStrength", &MpmFrictionalMat::tensileStrength));
} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmDruckerPragerMat)
static const yade::PluginClasses<yade::MpmDruckerPragerMat> registeredMpmDruckerPragerMat(__FILE__);
