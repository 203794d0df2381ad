// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/MpmBoundary.hpp"

namespace yade {

bool MpmBoundary::namesDirections(const string& letters)
{
	for (size_t i = 0; i < letters.size(); ++i)
		if (string("xyz").find(letters[i]) == string::npos || letters.find(letters[i], i + 1) != string::npos) return false;
	return !letters.empty();
}

void MpmBoundary::requireAdmissible() const
{
	Exposed<MpmBoundary, Serializable>::requireAdmissible();
	for (int axis = 0; axis < 3; ++axis) {
		const char         direction = "xyz"[axis];
		std::ostringstream text;
		if (min[axis] > max[axis])
			text << "MpmBoundary.min = " << min[axis] << " is greater than max = " << max[axis] << " along " << direction << "; are they swapped?";
		else if (displacement[axis] != 0 && !fixes(axis))
			text << "MpmBoundary.displacement = " << displacement[axis] << " along " << direction << ", a direction that fix = '" << fix
			     << "' leaves free.";
		if (!text.str().empty()) throw std::invalid_argument(text.str());
	}
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmBoundary)
static const yade::PluginClasses<yade::MpmBoundary> registered(__FILE__);
