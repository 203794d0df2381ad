// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/MpmElasticMat.hpp"
#include "core/materials/law.hpp"
#include "engine/materials/law_of_class.hpp"
#include "yade_api/registration.hpp"

namespace yade {

void MpmElasticMat::requireAdmissible() const
{
	ExposedIndexed<MpmElasticMat, MpmMaterial>::requireAdmissible();
	if (getClassName() != staticName() || !timeAttribute()) return;
	std::ostringstream text;
	text << "MpmElasticMat.relaxationTime = " << relaxationTime << " is not admitted: an elastic material has no yield beyond which stress could relax.";
	throw std::invalid_argument(text.str());
}

static const RegisteredLaw<MpmElasticMat> lawOfMpmElasticMat(
        [](const MpmElasticMat& m) { return gimpm::Hencky(m.young, m.poisson); }, std::pair("young", &MpmElasticMat::young));
} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmElasticMat)
static const yade::PluginClasses<yade::MpmElasticMat> registeredMpmElasticMat(__FILE__);
