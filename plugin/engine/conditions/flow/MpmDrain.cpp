// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/flow/MpmDrain.hpp"
#include "yade_api/registration.hpp"

namespace yade {

void MpmDrain::requireAdmissible() const
{
	Exposed<MpmDrain, Serializable>::requireAdmissible();
	surface->requireAdmissible();
	vector<string> given;
	if (pressure != 0) given.push_back("pressure = " + textOf(pressure));
	if (!std::isnan(level)) given.push_back("level = " + textOf(level));
	if (!levels.empty()) given.push_back("levels");
	if (!std::isnan(flux)) given.push_back("flux = " + textOf(flux));
	if (!std::isnan(rain)) given.push_back("rain = " + textOf(rain));
	if (given.size() > 1)
		throw std::invalid_argument(
		        "MpmDrain: " + given[0] + " and " + given[1] + " are given; one of pressure, level, levels, flux and rain is admitted.");
	if (seepage && !std::isnan(flux))
		throw std::invalid_argument(
		        "MpmDrain: seepage = True says that water can leave only, and flux = " + textOf(flux) + " how much leaves; leave one of the two out.");
	if (seepage && !std::isnan(rain))
		throw std::invalid_argument(
		        "MpmDrain: rain = " + textOf(rain)
		        + " enters, and water that the soil does not hold leaves by the same surface: leave seepage = True out.");
	if (hasLevel() && !curve.empty())
		throw std::invalid_argument("MpmDrain: curve is of pressure, flux or rain, and " + given[0] + " is given; leave one of the two out.");
	if (hasLevel() && seepage)
		throw std::invalid_argument(
		        "MpmDrain: above " + given[0] + " water can leave only without seepage = True, and below it enters; leave seepage out.");
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmDrain)
static const yade::PluginClasses<yade::MpmDrain> registeredMpmDrain(__FILE__);
