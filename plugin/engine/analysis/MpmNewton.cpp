// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/analysis/MpmNewton.hpp"
#include "yade_api/registration.hpp"
#include <sstream>

namespace yade {

void MpmNewton::requireAdmissible() const
{
	Exposed<MpmNewton, Serializable>::requireAdmissible();
	if (stepTolerance == 0 || (predictor && minStep <= 0.5)) return;
	std::ostringstream text;
	text << "MpmNewton.stepTolerance = " << stepTolerance;
	if (!predictor) text << " compares a step with its prediction, which predictor=False leaves out: set it to True, or stepTolerance=0.";
	else
		text << " cuts steps, which minStep = " << minStep << " does not admit: give minStep <= 1/2, or stepTolerance=0.";
	throw std::invalid_argument(text.str());
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmNewton)
static const yade::PluginClasses<yade::MpmNewton> registeredMpmNewton(__FILE__);
