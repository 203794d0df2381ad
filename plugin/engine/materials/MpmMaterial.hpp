// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/materials/conductivity.hpp"
#include "engine/materials/retention/MpmRetention.hpp"

namespace yade {

class MpmMaterial : public ExposedIndexed<MpmMaterial, Material> {
public:
	Real share
	        = 1; // part of the loads on its points in a stage of construction, whose density is as small; the stage gives it anew after a scene has been loaded

	// Soil that is being dug out: the stress of its grains is total stress, and water passes its pores without
	// pressing on them. Given as *share*.
	bool isDugOut = false;

	bool   undrained         = false;
	Real   waterModulus      = std::numeric_limits<Real>::quiet_NaN(); // without default
	Real   porosity          = std::numeric_limits<Real>::quiet_NaN();
	string conductivityLaw   = "constant";
	Real   conductivityIndex = std::numeric_limits<Real>::quiet_NaN();
	Real   relaxationTime    = std::numeric_limits<Real>::quiet_NaN();

	Conductivity             conductivity;
	shared_ptr<MpmRetention> retention; // none: always saturated

	YADE_API_NAME(MpmMaterial)
	static const char* doc()
	{
		return "Base of the materials of material points. It has no constitutive law itself and is refused when used.\n\n"
		       "Begin with MpmElasticMat. Page: plugin/docs/classes/MpmMaterial.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		// saved by YADE's Material, which admits every number
		v("density", &MpmMaterial::density, noSave, "Density [kg/m³] > 0 of the initial configuration.", positive);
		v("undrained", &MpmMaterial::undrained, 0,
		  "True: water cannot leave the pores; the law is that of effective stress, the water takes a pressure in excess (*MpmState.excessPressure*). Needs *waterModulus*.");
		v("waterModulus", &MpmMaterial::waterModulus, 0,
		  "Bulk modulus of the water over the porosity [Pa] > 0, with *undrained*: what the water adds to the soil's. 50 to 500 times that suffices; no default.",
		  admitting("a finite number > 0 [Pa], or NaN, the default: not given", [](Real value) {
			  return std::isnan(value) || (std::isfinite(value) && value > 0);
		  }));
		v("conductivity", &MpmMaterial::conductivity, 0,
		  "Hydraulic conductivity [m/s] >= 0 at the initial porosity, or a pair (horizontal, vertical) of layers, for *MpmImplicitEngine.flow*; 0: impervious.",
		  admitting(
		          "a finite number >= 0 [m/s], a pair of such (horizontal > 0, vertical), or NaN, the default: not given",
		          [](const Conductivity& value) { return value.isAdmissible(); }));
		v("porosity", &MpmMaterial::porosity, 0,
		  "Part of the initial volume [-] that is pores, between 0 and 1, both excluded, for *MpmImplicitEngine.flow*; no default.",
		  admitting("a number between 0 and 1, both excluded (percent over 100), or NaN, the default: not given", [](Real value) {
			  return std::isnan(value) || (value > 0 && value < 1);
		  }));
		v("conductivityLaw", &MpmMaterial::conductivityLaw, 0,
		  "Change of the conductivity with the porosity: 'constant'; 'kozeny-carman'; 'log': its decimal logarithm goes with the void ratio, over *conductivityIndex*.",
		  oneOf("constant", "kozeny-carman", "log"));
		v("conductivityIndex", &MpmMaterial::conductivityIndex, 0,
		  "Change of the void ratio [-] > 0 by which the conductivity grows tenfold, with conductivityLaw='log'; no default.",
		  admitting("a finite number > 0, or NaN, the default: not given", [](Real value) {
			  return std::isnan(value) || (std::isfinite(value) && value > 0);
		  }));
		v("retention", &MpmMaterial::retention, 0,
		  "Retention curve (MpmVanGenuchten, MpmGardner, MpmBrooksCorey, MpmRetentionTable), for *MpmFlow.total*; None, the default: the soil is always saturated.");
		v("relaxationTime", &MpmMaterial::relaxationTime, 0,
		  "Time [s] > 0 in which stress beyond yield goes to what the law bears (Duvaut and Lions); NaN, the default: at once. O.time must count seconds.",
		  admitting("a finite number > 0 [s], or NaN, the default: at once", [](Real value) {
			  return std::isnan(value) || (std::isfinite(value) && value > 0);
		  }));
	}
	shared_ptr<State> newAssocState() const override;
	bool              stateTypeOk(State*) const override;
	void              requireAdmissible() const override;
	void              pyHandleCustomCtorArgs(py::tuple&, py::dict& named) override { isDensityGiven = named.has_key("density"); }

	// True if a script has made it without a density, and has not changed that since.
	bool hasDefaultDensity() const { return !isDensityGiven && density == Material().density; }

	// std::invalid_argument if no step can begin from this state of a point.
	virtual void requireStart(const Matrix3r& /*stress*/) const { }

	// True if elastic energy is half Kirchhoff stress times elastic strain (linear Hencky elasticity).
	virtual bool hasHenckyElasticity() const { return false; }

	// The attribute by which its law depends on time in seconds; null: it does not.
	virtual const char* timeAttribute() const { return std::isnan(relaxationTime) ? nullptr : "relaxationTime"; }

	// Attributes [Pa] of which a number in another unit is doubted: its moduli; and its strengths, unless they grow
	// with the pressure: next to friction a cohesion may be next to nothing.
	using Quantities = vector<std::pair<const char*, Real>>;
	virtual Quantities moduli() const { return {}; }
	virtual Quantities strengths() const { return {}; }

private:
	bool isDensityGiven = true; // unless it is constructed by a script; not saved
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmMaterial)
