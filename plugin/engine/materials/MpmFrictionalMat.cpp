// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmFrictionalMat.hpp"
#include "yade_api/registration.hpp"

namespace yade {

void MpmFrictionalMat::requireAdmissible() const
{
	ExposedIndexed<MpmFrictionalMat, MpmElasticMat>::requireAdmissible();
	std::ostringstream text;
	if (getClassName() == staticName())
		text << "Material '" << label << "' is an " << staticName()
		     << ", which has no constitutive law: use a class derived from it, such as MpmMohrCoulombMat.";
	else if (dilationAngle > frictionAngle)
		text << getClassName() << ".dilationAngle = " << dilationAngle
		     << " is not admitted: expected an angle from 0 to frictionAngle = " << frictionAngle
		     << " [rad]. Soil that dilates more would give out work.";
	else if (cohesion == 0 && frictionAngle == 0)
		text << getClassName() << ".cohesion = 0 is not admitted: expected a number > 0 [Pa] without friction. Nothing would give it strength.";
	else
		return;
	throw std::invalid_argument(text.str());
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmFrictionalMat)
static const yade::PluginClasses<yade::MpmFrictionalMat> registeredMpmFrictionalMat(__FILE__);
