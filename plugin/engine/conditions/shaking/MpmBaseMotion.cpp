// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/shaking/MpmBaseMotion.hpp"
#include "yade_api/registration.hpp"
#include <algorithm>

namespace yade {

Real MpmBaseMotion::speedAt(Real time) const
{
	if (time < history.front().first || time > history.back().first) return 0;
	return gimpm::LoadCurve::valueAt(history, time);
}

// Exact: the velocity is linear between the knees.
Vector3r MpmBaseMotion::displacementBetween(Real begin, Real end) const
{
	Real sum  = 0;
	Real from = std::max(begin, history.front().first);
	auto knee = std::upper_bound(history.begin(), history.end(), from, [](Real t, const auto& k) { return t < k.first; });
	for (; from < end && knee != history.end(); ++knee) {
		const Real to = std::min(end, knee->first);
		sum += (to - from) * (speedAt(from) + speedAt(to)) / 2;
		from = to;
	}
	return sum * direction;
}

void MpmBaseMotion::requireInDimension(int dim, const string& name) const
{
	requireAdmissible();
	if (dim == 2 && direction[2] != 0)
		throw std::invalid_argument(
		        name + ".motion.direction = " + textOf(direction) + ": there is no direction z on a grid with dim=2 (plane strain in x-y).");
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmBaseMotion)
static const yade::PluginClasses<yade::MpmBaseMotion> registeredMpmBaseMotion(__FILE__);
