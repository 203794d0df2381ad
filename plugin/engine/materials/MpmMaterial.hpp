// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "yade_api/exposed.hpp"

namespace yade {

class MpmMaterial : public ExposedIndexed<MpmMaterial, Material> {
public:
	Real share
	        = 1; // of what acts on its points in a stage of construction, whose density is as small; the stage gives it anew after a scene has been loaded

	YADE_API_NAME(MpmMaterial)
	static const char* doc()
	{
		return "Base of the materials of material points. It has no constitutive law itself and is refused when used.\n\n"
		       "Begin with MpmElasticMat. Page: plugin/docs/theory.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		// saved by YADE's Material, which admits every number
		v("density", &MpmMaterial::density, noSave, "Density [kg/m³] > 0 of the initial configuration.", positive);
	}
	shared_ptr<State> newAssocState() const override;
	bool              stateTypeOk(State*) const override;
	void              requireAdmissible() const override;

	// std::invalid_argument if no step can begin from this state of a point.
	virtual void requireStart(const Matrix3r& /*stress*/) const { }

	// Attributes [Pa] of which a number in another unit is doubted: its moduli; and its strengths, unless they grow
	// with the pressure: next to friction a cohesion may be next to nothing.
	using Quantities = vector<std::pair<const char*, Real>>;
	virtual Quantities moduli() const { return {}; }
	virtual Quantities strengths() const { return {}; }
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmMaterial)
