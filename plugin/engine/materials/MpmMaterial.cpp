// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmMaterial.hpp"
#include "yade_api/registration.hpp"
#include "yade_api/scene.hpp"

namespace yade {

namespace {
	const char* const stateClass = "MpmState"; // which is of material points, and knows materials
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
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmMaterial)
static const yade::PluginClasses<yade::MpmMaterial> registeredMpmMaterial(__FILE__);
