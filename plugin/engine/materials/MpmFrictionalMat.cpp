// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmFrictionalMat.hpp"
#include "engine/materials/over_time.hpp"
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

gimpm::Law MpmFrictionalMat::law(Real viscosity, const std::function<gimpm::PowerElastic::Strength(Real, Real)>& make) const
{
	if (power == 0) return std::visit([&](const auto& own) { return overTime(*this, own, poisson, viscosity); }, make(young, poisson));
	const gimpm::PowerElastic::Moduli moduli { young, poisson, power, referencePressure };
	const gimpm::Hencky               secant = gimpm::PowerElastic::secant(moduli);
	return overTime(*this, gimpm::PowerElastic(moduli, make(secant.young(), secant.poisson())));
}

void MpmFrictionalMat::requireWithoutPower(const char* other, Real value, const char* instead) const
{
	if (power == 0) return;
	std::ostringstream text;
	text << getClassName() << ".power = " << power << " is not admitted with " << other << " = " << value << ": " << instead;
	throw std::invalid_argument(text.str());
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmFrictionalMat)
static const yade::PluginClasses<yade::MpmFrictionalMat> registeredMpmFrictionalMat(__FILE__);
