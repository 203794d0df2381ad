// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmVonMisesMat.hpp"
#include "core/materials/law.hpp"
#include "engine/materials/law_of_class.hpp"
#include "engine/materials/over_time.hpp"
#include "yade_api/registration.hpp"

namespace yade {

void MpmVonMisesMat::requireAdmissible() const
{
	ExposedIndexed<MpmVonMisesMat, MpmElasticMat>::requireAdmissible();
	requireOneOfTimes(*this, viscosity);
	std::ostringstream text;
	const Real         steepest = -std::sqrt(6.) * young / (2 * (1 + poisson));
	if (!(hardening > steepest))
		text << "MpmVonMisesMat.hardening = " << hardening << " is not admitted: expected a number > -sqrt(6) G = " << steepest
		     << " [Pa]. Stress would fall faster than it can by elastic unloading.";
	else if (residualYieldStress > yieldStress)
		text << "MpmVonMisesMat.residualYieldStress = " << residualYieldStress
		     << " is not admitted: expected a number from 0 to yieldStress = " << yieldStress << " [Pa], from which softening begins.";
	else
		return;
	throw std::invalid_argument(text.str());
}

} // namespace yade

namespace yade {
static const RegisteredLaw<MpmVonMisesMat> lawOfMpmVonMisesMat(
        [](const MpmVonMisesMat& m) {
	        return overTime(m, gimpm::VonMises(m.young, m.poisson, m.yieldStress, m.hardening, m.residualYieldStress), m.poisson, m.viscosity);
        },
        std::pair("young", &MpmElasticMat::young), std::pair("yieldStress", &MpmVonMisesMat::yieldStress), std::pair("hardening", &MpmVonMisesMat::hardening),
        std::pair("residualYieldStress", &MpmVonMisesMat::residualYieldStress));
} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmVonMisesMat)
static const yade::PluginClasses<yade::MpmVonMisesMat> registeredMpmVonMisesMat(__FILE__);
