// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/traction/MpmTraction.hpp"
#include "yade_api/registration.hpp"

namespace yade {

void MpmTraction::requireAdmissible() const
{
	Exposed<MpmTraction, Serializable>::requireAdmissible();
	surface->requireAdmissible();
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmTraction)
static const yade::PluginClasses<yade::MpmTraction> registeredMpmTraction(__FILE__);
