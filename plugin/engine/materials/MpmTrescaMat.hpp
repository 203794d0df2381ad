// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/materials/MpmElasticMat.hpp"

namespace yade {

class MpmTrescaMat : public ExposedIndexed<MpmTrescaMat, MpmElasticMat> {
public:
	Real undrainedStrength = std::numeric_limits<Real>::quiet_NaN(); // must be given, as the moduli

	YADE_API_NAME(MpmTrescaMat)
	static const char* doc()
	{
		return "Hencky elasticity with Tresca's perfect plasticity and associated flow: undrained clay by its strength in total stress. In plane strain it "
		       "differs from von Mises' law little, in 3D by up to 15 %.\n\n"
		       "Set first: *poisson* = 0.49 with MpmImplicitEngine(fBar=True), and *young* of 200 to 1000 *undrainedStrength*. Page: "
		       "plugin/docs/classes/MpmTrescaMat.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("undrainedStrength", &MpmTrescaMat::undrainedStrength, 0,
		  "Undrained shear strength c_u [Pa] > 0 in Kirchhoff stress: half of the largest difference of principal stresses.",
		  admitting("a finite number > 0 [Pa]; there is no default", positive));
	}
	Quantities strengths() const override { return { { "undrainedStrength", undrainedStrength } }; }
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmTrescaMat)
