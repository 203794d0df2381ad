// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmNorSandMat.hpp"
#include "core/materials/norsand.hpp"
#include "engine/materials/law_of_class.hpp"
#include "engine/materials/over_time.hpp"
#include "yade_api/registration.hpp"

namespace yade {

void MpmNorSandMat::requireAdmissible() const
{
	ExposedIndexed<MpmNorSandMat, MpmMaterial>::requireAdmissible();
	std::ostringstream text;
	if (flowCurvature > curvature)
		text << "MpmNorSandMat.flowCurvature = " << flowCurvature << " is not admitted: expected a number from 0 to curvature = " << curvature
		     << ". Sand that dilated more than by associated flow would give out work.";
	else if (!(swellingIndex < compressionIndex))
		text << "MpmNorSandMat.swellingIndex = " << swellingIndex
		     << " is not admitted: expected a number > 0 and < compressionIndex = " << compressionIndex
		     << ". Sand that swells as much as it is compressed has no plastic strain.";
	else
		return;
	throw std::invalid_argument(text.str());
}

void MpmNorSandMat::requireStart(const Matrix3r& stress) const
{
	if (!stress.isZero(0)) return;
	const string refusal = "MpmState.stress = 0 is not admitted: a point of an MpmNorSandMat has no stiffness without pressure. ";
	throw std::invalid_argument(refusal + "Give its stress with mpm.geostatic() or mpm.assign(stress=...).");
}

static const RegisteredLaw<MpmNorSandMat> lawOfMpmNorSandMat(
        [](const MpmNorSandMat& m) {
	        const gimpm::NorSand law({ m.shearModulus, m.swellingIndex, m.referencePressure, m.criticalStateRatio, m.compressionIndex, m.criticalVolume,
	                                   m.criticalPressure, m.curvature, std::isnan(m.flowCurvature) ? m.curvature : m.flowCurvature, m.hardening,
	                                   m.specificVolume, -m.dilatancyRatio });
	        return overTime(m, law);
        },
        std::pair("shearModulus", &MpmNorSandMat::shearModulus), std::pair("criticalStateRatio", &MpmNorSandMat::criticalStateRatio));
} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmNorSandMat)
static const yade::PluginClasses<yade::MpmNorSandMat> registeredMpmNorSandMat(__FILE__);
