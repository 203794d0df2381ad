// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/materials/retention/MpmRetention.hpp"
#include "yade_api/registration.hpp"

namespace yade {

using Law = gimpm::Retention;

bool MpmRetention::isFalling(const Table& table)
{
	for (size_t i = 0; i < table.size(); ++i) {
		const auto& [head, value] = table[i];
		if (!std::isfinite(head) || !std::isfinite(value)) return false;
		if (i > 0 && !(head > table[i - 1].first && value < table[i - 1].second)) return false;
	}
	return !table.empty() && table.front().first == 0 && table.front().second <= 1;
}

void MpmRetention::requireAdmissible() const
{
	if (getClassName() == staticName())
		throw std::invalid_argument("MpmRetention has no curve itself: use a class derived from it, such as MpmVanGenuchten.");
	Exposed<MpmRetention, Serializable>::requireAdmissible();
	if (residual >= saturated)
		throw std::invalid_argument(
		        getClassName() + ".residual = " + textOf(residual) + " must be below saturated = " + textOf(saturated)
		        + ": both are degrees of saturation, which are contents of water over the porosity.");
}

MpmRetention::Table MpmRetention::inPressures(Table table, Real unitWeight)
{
	for (auto& [head, value] : table)
		head *= unitWeight;
	return table;
}

Law MpmRetention::begun(Real unitWeight) const
{
	Law law;
	law.residual = residual, law.saturated = saturated, law.voidExponent = voidExponent;
	law.conducted = inPressures(permeabilities, unitWeight);
	return law;
}

Law MpmRetention::law(Real unitWeight) const { return begun(unitWeight); }

Law MpmVanGenuchten::law(Real unitWeight) const
{
	Law law   = begun(unitWeight);
	law.curve = Law::Curve::vanGenuchten, law.alpha = alpha / unitWeight, law.exponent = n;
	law.permeability = !permeabilities.empty() ? Law::Permeability::table
	        : permeability == "gardner"        ? Law::Permeability::exponential
	                                           : Law::Permeability::mualem;
	return law;
}

Law MpmGardner::law(Real unitWeight) const
{
	Law law   = begun(unitWeight);
	law.curve = Law::Curve::exponential, law.alpha = alpha / unitWeight;
	law.permeability = permeabilities.empty() ? Law::Permeability::exponential : Law::Permeability::table;
	return law;
}

Law MpmBrooksCorey::law(Real unitWeight) const
{
	Law law   = begun(unitWeight);
	law.curve = Law::Curve::brooksCorey, law.alpha = 1 / (entry * unitWeight), law.exponent = exponent;
	law.permeability = !permeabilities.empty() ? Law::Permeability::table
	        : permeability == "mualem"         ? Law::Permeability::mualem
	                                           : Law::Permeability::brooksCorey;
	return law;
}

void MpmRetentionTable::requireAdmissible() const
{
	Exposed<MpmRetentionTable, MpmRetention>::requireAdmissible();
	if (permeabilities.empty())
		throw std::invalid_argument(
		        "MpmRetentionTable has no permeabilities: a table of saturations has no form of the relative permeability. Give pairs of (head of suction, value).");
}

Law MpmRetentionTable::law(Real unitWeight) const
{
	Law law          = begun(unitWeight);
	law.curve        = Law::Curve::table;
	law.permeability = Law::Permeability::table;
	law.retained     = inPressures(saturations, unitWeight);
	law.saturated = law.retained.front().second, law.residual = law.retained.back().second;
	return law;
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmRetention)
BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmVanGenuchten)
BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmGardner)
BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmBrooksCorey)
BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmRetentionTable)
static const yade::PluginClasses<yade::MpmRetention, yade::MpmVanGenuchten, yade::MpmGardner, yade::MpmBrooksCorey, yade::MpmRetentionTable>
        registeredMpmRetention(__FILE__);
