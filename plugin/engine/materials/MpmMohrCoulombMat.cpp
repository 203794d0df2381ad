// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmMohrCoulombMat.hpp"
#include "core/materials/law.hpp"
#include "core/materials/softening_mohr_coulomb.hpp"
#include "engine/materials/law_of_class.hpp"
#include "engine/materials/over_time.hpp"
#include "yade_api/registration.hpp"

namespace yade {

namespace {
	Real orElse(Real residual, Real first) { return std::isnan(residual) ? first : residual; }
}

void MpmMohrCoulombMat::requireAdmissible() const
{
	ExposedIndexed<MpmMohrCoulombMat, MpmFrictionalMat>::requireAdmissible();
	std::ostringstream text;
	const auto         requireLess = [&](const char* name, Real residual, const char* of, Real first, const char* unit) {
                if (residual > first && text.str().empty())
                        text << "MpmMohrCoulombMat." << name << " = " << residual << " is not admitted: expected a number from 0 to " << of << " = " << first
                             << " [" << unit << "], from which softening begins.";
	};
	requireLess("residualCohesion", residualCohesion, "cohesion", cohesion, "Pa");
	requireLess("residualFrictionAngle", residualFrictionAngle, "frictionAngle", frictionAngle, "rad");
	requireLess("residualDilationAngle", residualDilationAngle, "dilationAngle", dilationAngle, "rad");
	const bool hasResidual = !std::isnan(residualCohesion) || !std::isnan(residualFrictionAngle) || !std::isnan(residualDilationAngle);
	if (text.str().empty() && hasResidual == std::isnan(softeningStrain))
		text << "MpmMohrCoulombMat.softeningStrain = " << softeningStrain << " is not admitted "
		     << (hasResidual ? "with a residual strength: give the plastic strain over which strength falls to it."
		                     : "alone: give residualCohesion, residualFrictionAngle or residualDilationAngle, to which it leads.");
	else if (text.str().empty() && hasResidual && orElse(residualCohesion, cohesion) == 0 && orElse(residualFrictionAngle, frictionAngle) == 0)
		text << "MpmMohrCoulombMat.residualCohesion = 0 is not admitted: expected a number > 0 [Pa] without residual friction. Nothing would be left.";
	if (!text.str().empty()) throw std::invalid_argument(text.str());
	if (!std::isnan(softeningStrain))
		requireWithoutPower("softeningStrain", softeningStrain, "soil that softens has moduli that stay; leave one of the two out.");
}

namespace {
	gimpm::Law lawOfMohrCoulomb(const MpmMohrCoulombMat& m)
	{
		const auto make = [&](Real young, Real poisson) {
			return gimpm::MohrCoulomb(young, poisson, m.cohesion, m.frictionAngle, m.dilationAngle, m.tensileStrength);
		};
		if (std::isnan(m.softeningStrain)) return m.law(0, make);
		const gimpm::SofteningMohrCoulomb::Residual residual { orElse(m.residualCohesion, m.cohesion), orElse(m.residualFrictionAngle, m.frictionAngle),
			                                               orElse(m.residualDilationAngle, m.dilationAngle), m.softeningStrain };
		return overTime(m, gimpm::SofteningMohrCoulomb(make(m.young, m.poisson), m.poisson, residual));
	}
}

static const RegisteredLaw<MpmMohrCoulombMat> lawOfMpmMohrCoulombMat(
        lawOfMohrCoulomb, std::pair("young", &MpmElasticMat::young), std::pair("cohesion", &MpmFrictionalMat::cohesion),
        std::pair("frictionAngle", &MpmFrictionalMat::frictionAngle), std::pair("dilationAngle", &MpmFrictionalMat::dilationAngle),
        std::pair("tensileStrength", &MpmFrictionalMat::tensileStrength));
} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmMohrCoulombMat)
static const yade::PluginClasses<yade::MpmMohrCoulombMat> registeredMpmMohrCoulombMat(__FILE__);
