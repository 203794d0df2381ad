// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/laws.hpp"
#include "engine/MpmElasticMat.hpp"
#include "engine/MpmVonMisesMat.hpp"
#include <typeindex>
#include <unordered_map>

namespace yade {

namespace {
	using ToLaw = gimpm::Law (*)(const MpmMaterial&);

	const std::unordered_map<std::type_index, ToLaw> laws {
		{ typeid(MpmElasticMat),
		  [](const MpmMaterial& material) -> gimpm::Law {
			  const auto& m = static_cast<const MpmElasticMat&>(material);
			  return gimpm::Hencky(m.young, m.poisson);
		  } },
		{ typeid(MpmVonMisesMat),
		  [](const MpmMaterial& material) -> gimpm::Law {
			  const auto& m = static_cast<const MpmVonMisesMat&>(material);
			  return gimpm::VonMises(m.young, m.poisson, m.yieldStress);
		  } },
	};
}

gimpm::Material coreMaterial(const MpmMaterial& material)
{
	material.requireAdmissible();
	const auto law = laws.find(typeid(material));
	if (law == laws.end()) throw std::invalid_argument("Material class " + material.getClassName() + " has no constitutive law.");
	return { law->second(material), material.density };
}

} // namespace yade
