// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/idle_boundaries.hpp"
#include "engine/solver/MpmImplicitEngine.hpp"
#include "engine/solver/processes.hpp"

namespace yade {

namespace {
	// Of each boundary that no point is near, wherever the points are: not zero.
	vector<int64_t> areIdle(const MpmImplicitEngine& engine, const vector<MaterialPoint>& points)
	{
		const int       dim = engine.grid->dim;
		vector<int64_t> isIdle;
		for (const auto& boundary : engine.boundaries) {
			const auto [lower, upper] = boundary->extent();
			const auto isNear         = [&, low = lower, high = upper](const MaterialPoint& p) {
                                const Vector3r reach = p.shape->halfSize + Vector3r::Constant(engine.grid->cellSize); // nodes of the cells that it touches
                                return ((p.state->pos + reach - low).head(dim).array() > 0).all()
                                        && ((high - p.state->pos + reach).head(dim).array() > 0).all();
			};
			isIdle.push_back(std::none_of(points.begin(), points.end(), isNear));
		}
		holdersOf(engine)->smallest(isIdle.data(), int(isIdle.size()));
		return isIdle;
	}
}

string idleBoundaries(const MpmImplicitEngine& engine, const vector<MaterialPoint>& points, const vector<const MpmBoundary*>& except)
{
	if (engine.boundaries.empty()) return " The engine has no boundaries.";
	std::ostringstream text;
	const auto         isIdle = areIdle(engine, points);
	for (size_t b = 0; b < engine.boundaries.size(); ++b) {
		const MpmBoundary& boundary = *engine.boundaries[b];
		if (std::find(except.begin(), except.end(), &boundary) != except.end()) continue;
		const auto [lower, upper] = boundary.extent();
		if (isIdle[b])
			text << " boundaries[" << b << "], from (" << lower.transpose() << ") to (" << upper.transpose() << "), holds "
			     << (boundary.surface ? "no material." : "no node of any material.");
	}
	return text.str();
}

string idleContacts(const MpmImplicitEngine& engine)
{
	std::ostringstream text;
	for (size_t c = 0; c < engine.contacts.size(); ++c) {
		const vector<int>& touching = engine.contacts[c]->touching;
		if (std::any_of(touching.begin(), touching.end(), [](int corners) { return corners > 0; })) continue;
		text << " contacts[" << c << "] touches nothing yet: a body holds what it touches, and by friction (MpmContact.friction) also along itself.";
	}
	return text.str();
}

} // namespace yade
