// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmMaterial.hpp"
#include "yade_api/registration.hpp"
#include "yade_api/scene.hpp"

namespace yade {

namespace {
	const char* const stateClass = "MpmState"; // class of material points, which knows materials
}

shared_ptr<State> MpmMaterial::newAssocState() const
{
	return boost::dynamic_pointer_cast<State>(Singleton<ClassFactory>::instance().createShared(stateClass));
}

bool MpmMaterial::stateTypeOk(State* state) const { return state && state->getClassName() == stateClass; }

void MpmMaterial::requireAdmissible() const
{
	if (getClassName() == staticName())
		throw std::invalid_argument(
		        "Material '" + label + "' is an MpmMaterial, which has no constitutive law: use a class derived from it, such as MpmElasticMat.");
	ExposedIndexed<MpmMaterial, Material>::requireAdmissible();
	if (retention) retention->requireAdmissible();
	if (undrained && std::isnan(waterModulus))
		throw std::invalid_argument(
		        "Material '" + label
		        + "': undrained = True needs waterModulus [Pa], the bulk modulus of the water over the porosity: 2.2e9 Pa over the porosity, or, which suffices and "
		          "converges better, 50 to 500 times the bulk modulus of the soil.");
	if (conductivityLaw == "log" && std::isnan(conductivityIndex))
		throw std::invalid_argument(
		        "Material '" + label
		        + "': conductivityLaw = 'log' needs conductivityIndex, the change of the void ratio by which the conductivity grows tenfold.");
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmMaterial)
static const yade::PluginClasses<yade::MpmMaterial> registeredMpmMaterial(__FILE__);
