// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/MpmTraction.hpp"

namespace yade {

void MpmTraction::requireAdmissible() const
{
	Exposed<MpmTraction, Serializable>::requireAdmissible();
	surface->requireAdmissible();
	if (pressure == 0 && traction.isZero(0))
		throw std::invalid_argument("MpmTraction: pressure = 0 and traction = (0, 0, 0): there is no load; give one of them, or leave it out.");
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmTraction)
static const yade::PluginClasses<yade::MpmTraction> registered(__FILE__);
