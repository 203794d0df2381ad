// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/shaking/MpmAbsorbingBoundary.hpp"
#include "engine/conditions/shaking/edges.hpp"
#include "engine/grid/box.hpp"
#include "yade_api/registration.hpp"

namespace yade {

void MpmAbsorbingBoundary::requireAdmissible() const
{
	Exposed<MpmAbsorbingBoundary, MpmCondition>::requireAdmissible();
	if (motion) motion->requireAdmissible();
	requireCorners("MpmAbsorbingBoundary", min, max);
}

std::shared_ptr<Condition<2>> MpmAbsorbingBoundary::make(InPlane, const Group& group, const Analysis& analysis) const
{
	return std::make_shared<Edges<2>>(group, analysis);
}

std::shared_ptr<Condition<3>> MpmAbsorbingBoundary::make(InSpace, const Group& group, const Analysis& analysis) const
{
	return std::make_shared<Edges<3>>(group, analysis);
}

void MpmAbsorbingBoundary::tell(Rows& rows, const Analysis& analysis, const Listed& listed) const
{
	rows.setVector("absorbing" + std::to_string(listed.number), reaction, analysis.grid->dim);
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmAbsorbingBoundary)
static const yade::PluginClasses<yade::MpmAbsorbingBoundary> registeredMpmAbsorbingBoundary(__FILE__);
