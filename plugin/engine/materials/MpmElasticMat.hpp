// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/materials/MpmMaterial.hpp"

namespace yade {

class MpmElasticMat : public ExposedIndexed<MpmElasticMat, MpmMaterial> {
public:
	// NaN until given: a modulus that nobody chose would be worse than an error
	Real young   = std::numeric_limits<Real>::quiet_NaN();
	Real poisson = std::numeric_limits<Real>::quiet_NaN();

	YADE_API_NAME(MpmElasticMat)
	static const char* doc()
	{
		return "Isotropic Hencky elasticity: Kirchhoff stress linear in the logarithmic strain (Coombs 2023, section 2). *young* and *poisson* must be "
		       "given.\n\n"
		       "Set first: *poisson* up to 0.3; from 0.45 on MpmImplicitEngine(fBar=True). Page: plugin/docs/classes/MpmElasticMat.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("young", &MpmElasticMat::young, 0, "Young's modulus [Pa] > 0, without default.",
		  admitting("a finite number > 0 [Pa]; there is no default", positive));
		v("poisson", &MpmElasticMat::poisson, 0, "Poisson's ratio [-] between -1 and 0.5, both excluded, without default.",
		  admitting("a number between -1 and 0.5, both excluded; there is no default", strictlyBetween(-1, 0.5)));
	}
	void       requireAdmissible() const override;
	Quantities moduli() const override { return { { "young", young } }; }
	bool       hasHenckyElasticity() const override { return true; }
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmElasticMat)
