// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmMaterial.hpp"
#include "engine/points/MpmState.hpp"
#include "yade_api/registration.hpp"

namespace yade {

shared_ptr<State> MpmMaterial::newAssocState() const { return shared_ptr<State>(new MpmState); }

bool MpmMaterial::stateTypeOk(State* state) const { return dynamic_cast<MpmState*>(state); }

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
