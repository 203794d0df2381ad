// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/MpmAbsorbingBoundary.hpp"

namespace yade {

void MpmAbsorbingBoundary::requireAdmissible() const
{
	Exposed<MpmAbsorbingBoundary, Serializable>::requireAdmissible();
	if (motion) motion->requireAdmissible();
	for (int axis = 0; axis < 3; ++axis)
		if (min[axis] > max[axis]) {
			std::ostringstream text;
			text << "MpmAbsorbingBoundary.min = " << min[axis] << " is greater than max = " << max[axis] << " along "
			     << "xyz"[axis] << "; are they swapped?";
			throw std::invalid_argument(text.str());
		}
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmAbsorbingBoundary)
static const yade::PluginClasses<yade::MpmAbsorbingBoundary> registered(__FILE__);
