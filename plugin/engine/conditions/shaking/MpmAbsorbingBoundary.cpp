// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/shaking/MpmAbsorbingBoundary.hpp"
#include "engine/conditions/box.hpp"
#include "yade_api/registration.hpp"

namespace yade {

void MpmAbsorbingBoundary::requireAdmissible() const
{
	Exposed<MpmAbsorbingBoundary, Serializable>::requireAdmissible();
	if (motion) motion->requireAdmissible();
	requireCorners("MpmAbsorbingBoundary", min, max);
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmAbsorbingBoundary)
static const yade::PluginClasses<yade::MpmAbsorbingBoundary> registeredMpmAbsorbingBoundary(__FILE__);
