// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/shaking/MpmBaseMotion.hpp"
#include "core/base/sentence.hpp"
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

// The criteria of mpm.record: an acceleration changes much faster than a velocity, and drifts when it is taken for one.
// Pulses and other short histories are not judged.
string MpmBaseMotion::doubt(const string& name) const
{
	constexpr size_t fewest   = 100;
	constexpr Real   shortest = 5; // [s]
	if (history.size() < fewest || history.back().first - history.front().first < shortest) return "";
	Real largest = 0, rate = 0, way = 0, farthest = 0;
	for (size_t k = 1; k < history.size(); ++k) {
		const auto& [t0, v0] = history[k - 1];
		const auto& [t1, v1] = history[k];
		rate                 = std::max(rate, std::abs(v1 - v0) / (t1 - t0));
		way += (t1 - t0) * (v0 + v1) / 2;
		largest  = std::max({ largest, std::abs(v0), std::abs(v1) });
		farthest = std::max(farthest, std::abs(way));
	}
	const Real size    = direction.norm();
	const bool isDrift = std::abs(way) > 0.3 * farthest;
	if (largest == 0 || (rate <= 40 * largest && rate * size <= 50 && !(isDrift && rate > 10 * largest))) return "";
	return gimpm::sentence(
	        name, ".motion.history is of velocities [m/s], and these would change by up to ", rate * size, " m/s2, ", rate / largest,
	        " 1/s times the largest (velocities of earthquakes: 4 to 30): is it a record of accelerations? mpm.record(...).motion() integrates one.");
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
