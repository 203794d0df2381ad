// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/structures/parting.hpp"
#include "engine/analysis/analysis.hpp"

namespace yade {

string obstacleToParting(const Analysis& analysis)
{
	if (!analysis.grid->period.isZero(0)) return "MpmGrid.period";
	if (analysis.nonlocalLength > 0) return "nonlocalLength";
	if (analysis.pressureRelaxation) return "pressureRelaxation";
	if (analysis.newton->linearSolver == "amg") return "MpmNewton.linearSolver = 'amg'";
	for (const Listed& listed : analysis.conditions())
		if (const string own = listed.condition->needsUntiedNodes(listed.name()); !own.empty()) return own;
	return "";
}

} // namespace yade
