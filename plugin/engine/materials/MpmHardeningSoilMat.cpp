// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmHardeningSoilMat.hpp"
#include "core/materials/hardening_soil_small.hpp"
#include "engine/materials/law_of_class.hpp"
#include "engine/materials/over_time.hpp"
#include "yade_api/registration.hpp"

namespace yade {

gimpm::HardeningSoil::Given MpmHardeningSoilMat::given() const
{
	return { E50ref, Eoedref, Eurref, poisson, power, failureRatio, K0nc, referencePressure, cohesion, frictionAngle, dilationAngle, mostDilation };
}

namespace {
	// Missing or contradictory attributes, as "attribute = value is not admitted: expected ..."; empty: nothing.
	string contradiction(const MpmHardeningSoilMat& m)
	{
		std::ostringstream text;
		const auto         refuse = [&](const char* name, Real value) -> std::ostringstream& {
                        text << "MpmHardeningSoilMat." << name << " = " << value << " is not admitted: expected ";
                        return text;
		};
		using Law = gimpm::HardeningSoil;
		if (m.dilationAngle > m.frictionAngle)
			refuse("dilationAngle", m.dilationAngle)
			        << "an angle from 0 to frictionAngle = " << m.frictionAngle << " [rad]. Soil that dilates more would give out work.";
		else if (const Real first = 2 * m.E50ref / (2 - m.failureRatio); !(m.Eurref > first))
			refuse("Eurref", m.Eurref)
			        << "a number > 2 E50ref / (2 - failureRatio) = " << first
			        << " [Pa], the first modulus of the hyperbola: soil is stiffer when it is unloaded. Two to five times E50ref are usual.";
		else if (const Real least = Law::leastRestRatio(m.given()); !(m.K0nc > least))
			refuse("K0nc", m.K0nc) << "a number > " << least << ", that of active earth pressure for frictionAngle = " << m.frictionAngle
			                       << " [rad]: first loading would be beyond the strength. 1 - sin(phi) = " << 1 - std::sin(m.frictionAngle)
			                       << " is usual.";
		else if (const Real most = Law::largestOedometric(m.given()); !(m.Eoedref < most))
			refuse("Eoedref", m.Eoedref)
			        << "a number < " << most << " [Pa]: with E50ref = " << m.E50ref << " [Pa], Eurref = " << m.Eurref
			        << " [Pa] and K0nc = " << m.K0nc
			        << " the strains of shear and elasticity alone are those of such a modulus. Give a smaller Eoedref, a larger E50ref or another K0nc.";
		else if (std::isnan(m.G0ref) != std::isnan(m.gamma07))
			text << "MpmHardeningSoilMat: G0ref = " << m.G0ref << " and gamma07 = " << m.gamma07 << " belong together; give both of them or none.";
		else if (const Real unloading = m.Eurref / (2 * (1 + m.poisson)); m.G0ref < unloading)
			refuse("G0ref", m.G0ref) << "a number >= Eurref / (2 + 2 poisson) = " << unloading
			                         << " [Pa], the shear modulus of unloading: small strains are stiffer.";
		return text.str();
	}
}

void MpmHardeningSoilMat::requireAdmissible() const
{
	ExposedIndexed<MpmHardeningSoilMat, MpmMaterial>::requireAdmissible();
	if (const string said = contradiction(*this); !said.empty()) throw std::invalid_argument(said);
}

namespace {
	gimpm::Law lawOfSoil(const MpmHardeningSoilMat& m)
	{
		if (std::isnan(m.G0ref)) return overTime(m, gimpm::HardeningSoil(m.given()));
		return overTime(m, gimpm::HardeningSoilSmall(m.given(), m.G0ref, m.gamma07));
	}
}

static const RegisteredLaw<MpmHardeningSoilMat> lawOfMpmHardeningSoilMat(
        lawOfSoil, std::pair("E50ref", &MpmHardeningSoilMat::E50ref), std::pair("Eoedref", &MpmHardeningSoilMat::Eoedref),
        std::pair("Eurref", &MpmHardeningSoilMat::Eurref), std::pair("cohesion", &MpmHardeningSoilMat::cohesion),
        std::pair("frictionAngle", &MpmHardeningSoilMat::frictionAngle), std::pair("dilationAngle", &MpmHardeningSoilMat::dilationAngle));
} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmHardeningSoilMat)
static const yade::PluginClasses<yade::MpmHardeningSoilMat> registeredMpmHardeningSoilMat(__FILE__);
