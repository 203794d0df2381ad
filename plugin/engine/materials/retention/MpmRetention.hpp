// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "core/materials/retention.hpp"
#include "yade_api/exposed.hpp"

namespace yade {

class MpmRetention : public Exposed<MpmRetention, Serializable> {
public:
	using Table = gimpm::Retention::Table; // heads of suction [m] and values

	Real  residual = 0, saturated = 1, voidExponent = 0;
	Table permeabilities; // empty: by the form of the curve

	YADE_API_NAME(MpmRetention)
	static const char* doc()
	{
		return "Base of the retention curves of soils: the degree of saturation at a suction, and the relative permeability. It has no curve itself.\n\n"
		       "Begin with MpmVanGenuchten. Page: plugin/docs/classes/MpmRetention.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("residual", &MpmRetention::residual, 0, "Degree of saturation [-] of dry soil, between 0, the default, and *saturated*.",
		  admitting("a number >= 0 and < 1", [](Real value) { return value >= 0 && value < 1; }));
		v("saturated", &MpmRetention::saturated, 0, "Degree of saturation [-] without suction, above *residual*; 1, the default: no air is left.",
		  part);
		v("voidExponent", &MpmRetention::voidExponent, 0,
		  "Power [-] >= 0 of the void ratio over the initial one that multiplies suction (Gallipoli and others 2003); 0, the default: the curve stays.",
		  nonNegative);
		v("permeabilities", &MpmRetention::permeabilities, 0,
		  "Relative permeability as a sequence of (suction as a head of water [m], value), linear in its logarithm between; empty, the default: by the form of the curve.",
		  admitting("pairs of a head that increases from 0 and a value > 0 that falls from 1, or nothing", [](const Table& table) {
			  return table.empty() || (isFalling(table) && table.front().second == 1 && table.back().second > 0);
		  }));
	}

	// The attributes must go together, too.
	void requireAdmissible() const override;

	// In units of pressure, for water of a weight by volume [N/m³].
	virtual gimpm::Retention law(Real unitWeight) const;

	static bool isFalling(const Table&); // from the head zero on, values <= 1

protected:
	gimpm::Retention begun(Real unitWeight) const; // what all curves have
	static Table     inPressures(Table, Real unitWeight);
};

class MpmVanGenuchten : public Exposed<MpmVanGenuchten, MpmRetention> {
public:
	Real   alpha        = std::numeric_limits<Real>::quiet_NaN(); // must be given
	Real   n            = std::numeric_limits<Real>::quiet_NaN(); // must be given
	string permeability = "mualem";

	YADE_API_NAME(MpmVanGenuchten)
	static const char* doc()
	{
		return "Van Genuchten's retention curve, with Mualem's relative permeability: effective saturation (1 + (alpha s)^n)^(1/n - 1) at a head of suction s.\n\n"
		       "Set first: *alpha*, *n*, *residual*. Page: plugin/docs/classes/MpmRetention.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("alpha", &MpmVanGenuchten::alpha, 0, "Inverse of a head of suction [1/m] > 0; sand 15, silt 1.5, clay 0.5; no default.", positive);
		v("n", &MpmVanGenuchten::n, 0, "Exponent [-] > 1; sand 2.7, silt 1.4, clay 1.1; no default.",
		  admitting("a finite number > 1; there is no default", [](Real value) { return std::isfinite(value) && value > 1; }));
		v("permeability", &MpmVanGenuchten::permeability, 0, "Form of the relative permeability: 'mualem', the default, or 'gardner', exp(-alpha s).",
		  oneOf("mualem", "gardner"));
	}
	gimpm::Retention law(Real unitWeight) const override;
};

class MpmGardner : public Exposed<MpmGardner, MpmRetention> {
public:
	Real alpha = std::numeric_limits<Real>::quiet_NaN(); // must be given

	YADE_API_NAME(MpmGardner)
	static const char* doc()
	{
		return "Gardner's exponential soil: effective saturation and relative permeability are exp(-alpha s) at a head of suction s.\n\n"
		       "Set first: *alpha*, *residual*. Page: plugin/docs/classes/MpmRetention.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("alpha", &MpmGardner::alpha, 0, "Inverse of a head of suction [1/m] > 0; sand 10, clay 1; no default.", positive);
	}
	gimpm::Retention law(Real unitWeight) const override;
};

class MpmBrooksCorey : public Exposed<MpmBrooksCorey, MpmRetention> {
public:
	Real   entry        = std::numeric_limits<Real>::quiet_NaN(); // must be given
	Real   exponent     = std::numeric_limits<Real>::quiet_NaN(); // must be given
	string permeability = "brooks-corey";

	YADE_API_NAME(MpmBrooksCorey)
	static const char* doc()
	{
		return "Brooks and Corey's retention curve: effective saturation (entry / s)^exponent where the head of suction s is above *entry*, one below.\n\n"
		       "Set first: *entry*, *exponent*, *residual*. Page: plugin/docs/classes/MpmRetention.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("entry", &MpmBrooksCorey::entry, 0, "Head of suction [m] > 0 at which air enters; no default.", positive);
		v("exponent", &MpmBrooksCorey::exponent, 0, "Index of the sizes of the pores [-] > 0; no default.", positive);
		v("permeability", &MpmBrooksCorey::permeability, 0,
		  "Power of the effective saturation that is the relative permeability: 'brooks-corey', the default, 3 + 2/exponent, or 'mualem', 2.5 + 2/exponent.",
		  oneOf("brooks-corey", "mualem"));
	}
	gimpm::Retention law(Real unitWeight) const override;
};

class MpmRetentionTable : public Exposed<MpmRetentionTable, MpmRetention> {
public:
	Table saturations; // must be given

	YADE_API_NAME(MpmRetentionTable)
	static const char* doc()
	{
		return "Retention curve of measured values, linear between them; *residual* and *saturated* are those of the table.\n\n"
		       "Set first: *saturations*, *permeabilities*. Page: plugin/docs/classes/MpmRetention.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("saturations", &MpmRetentionTable::saturations, 0,
		  "Degree of saturation as a sequence of two or more (suction as a head of water [m], value); without default.",
		  admitting("two or more pairs of a head that increases from 0 and a value <= 1 that falls", [](const Table& table) {
			  return table.size() > 1 && isFalling(table) && table.back().second >= 0;
		  }));
	}
	void             requireAdmissible() const override;
	gimpm::Retention law(Real unitWeight) const override;
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmRetention)
BOOST_CLASS_EXPORT_KEY(yade::MpmVanGenuchten)
BOOST_CLASS_EXPORT_KEY(yade::MpmGardner)
BOOST_CLASS_EXPORT_KEY(yade::MpmBrooksCorey)
BOOST_CLASS_EXPORT_KEY(yade::MpmRetentionTable)
