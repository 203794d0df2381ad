// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmCamClayMat.hpp"
#include "core/materials/law.hpp"
#include "engine/materials/law_of_class.hpp"
#include "engine/materials/over_time.hpp"
#include "yade_api/registration.hpp"

namespace yade {

void MpmCamClayMat::requireAdmissible() const
{
	ExposedIndexed<MpmCamClayMat, MpmMaterial>::requireAdmissible();
	if (swellingIndex < compressionIndex) return;
	std::ostringstream text;
	text << "MpmCamClayMat.swellingIndex = " << swellingIndex << " is not admitted: expected a number > 0 and < compressionIndex = " << compressionIndex
	     << ". Soil that swells as much as it is compressed has no plastic strain.";
	throw std::invalid_argument(text.str());
}

void MpmCamClayMat::requireStart(const Matrix3r& stress) const
{
	if (!stress.isZero(0)) return;
	const string refusal = "MpmState.stress = 0 is not admitted: a point of an MpmCamClayMat has no stiffness without pressure. ";
	throw std::invalid_argument(refusal + "Give its stress with mpm.geostatic() or mpm.assign(stress=...).");
}

} // namespace yade

namespace yade {
static const RegisteredLaw<MpmCamClayMat> lawOfMpmCamClayMat(
        [](const MpmCamClayMat& m) {
	        return overTime(
	                m, gimpm::CamClay(m.shearModulus, m.criticalStateRatio, m.compressionIndex, m.swellingIndex, m.preconsolidation, m.referencePressure),
	                0);
        },
        std::pair("shearModulus", &MpmCamClayMat::shearModulus), std::pair("criticalStateRatio", &MpmCamClayMat::criticalStateRatio));
} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmCamClayMat)
static const yade::PluginClasses<yade::MpmCamClayMat> registeredMpmCamClayMat(__FILE__);
