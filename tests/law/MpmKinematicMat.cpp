// SPDX-License-Identifier: GPL-2.0-or-later
// A class of materials that the plugin does not have, with a tensor law that it does not have either.
#include "engine/materials/MpmElasticMat.hpp"
#include "engine/materials/law_of_class.hpp"
#include "law/kinematic_hardening.hpp"
#include "yade_api/registration.hpp"

namespace yade {

class MpmKinematicMat : public ExposedIndexed<MpmKinematicMat, MpmElasticMat> {
public:
	Real yieldStress = std::numeric_limits<Real>::quiet_NaN();
	Real hardening   = 0;
	Real viscosity   = 0;

	YADE_API_NAME(MpmKinematicMat)
	static const char*             doc() { return "Von Mises plasticity with a back stress that grows linearly (Prager), of the tests."; }
	template <class V> static void attributes(V&& v)
	{
		v("yieldStress", &MpmKinematicMat::yieldStress, 0, "Yield strength [Pa] > 0, the length of deviator less back stress.",
		  admitting("a finite number > 0 [Pa]; there is no default", positive));
		v("hardening", &MpmKinematicMat::hardening, 0, "Growth of the back stress [Pa] >= 0 per plastic strain.", nonNegative);
		v("viscosity", &MpmKinematicMat::viscosity, 0, "Stress beyond yield [Pa s] >= 0 per rate of plastic strain.", nonNegative);
	}
	Quantities strengths() const override { return { { "yieldStress", yieldStress } }; }
};

static const RegisteredLaw<MpmKinematicMat> lawOfMpmKinematicMat(
        [](const MpmKinematicMat& m) { return gimpm::KinematicHardening(m.young, m.poisson, m.yieldStress, m.hardening, m.viscosity); },
        std::pair("young", &MpmElasticMat::young), std::pair("yieldStress", &MpmKinematicMat::yieldStress),
        std::pair("hardening", &MpmKinematicMat::hardening));

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmKinematicMat)
BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmKinematicMat)
static const yade::PluginClasses<yade::MpmKinematicMat> registeredMpmKinematicMat(__FILE__);
