// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmVonMisesMat.hpp"
#include "yade_api/registration.hpp"

namespace yade {

void MpmVonMisesMat::requireAdmissible() const
{
	ExposedIndexed<MpmVonMisesMat, MpmElasticMat>::requireAdmissible();
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

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmVonMisesMat)
static const yade::PluginClasses<yade::MpmVonMisesMat> registeredMpmVonMisesMat(__FILE__);
