// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/messages/sticking.hpp"
#include "core/grid/parts_of_body.hpp"
#include <algorithm>
#include <map>

namespace yade {

namespace {
	template <int Dim> gimpm::DomainBox<Dim> boxOf(const MaterialPoint& point)
	{
		return gimpm::domainBox<Dim>(point.state->pos.template head<Dim>(), point.shape->halfSize.template head<Dim>());
	}

	// True if two bodies, or a body and points of none (-1), have a contact.
	bool haveContact(const Analysis& analysis, int one, int other)
	{
		const auto all = analysis.conditions();
		return one >= 0 && std::any_of(all.begin(), all.end(), [&](const Listed& listed) {
			       return listed.condition->isBetween(analysis.grid->nameOfWhole(one), analysis.grid->nameOfWhole(other));
		       });
	}

	// Pairs whose domains share nodes, of those that are asked for.
	template <int Dim>
	std::set<std::pair<int, int>> pairsThatStick(const Analysis& analysis, const vector<MaterialPoint>& points, const std::set<std::pair<int, int>>& pairs)
	{
		const Real                           h = analysis.grid->cellSize;
		std::map<int, gimpm::DomainBox<Dim>> around; // all domains of a body
		for (const MaterialPoint& point : points) {
			const auto box         = boxOf<Dim>(point);
			const auto [at, isNew] = around.emplace(point.state->body, box);
			if (!isNew) at->second = { at->second.low.cwiseMin(box.low), at->second.high.cwiseMax(box.high) };
		}
		std::set<std::pair<int, int>> found;
		for (const auto& [one, other] : pairs) {
			if (!around.count(one) || !around.count(other)) continue;
			const gimpm::Vec<Dim> low  = around[one].low.cwiseMax(around[other].low).array() - 2 * h,
			                      high = around[one].high.cwiseMin(around[other].high).array() + 2 * h;
			if ((high - low).minCoeff() < 0) continue;
			vector<gimpm::DomainBox<Dim>> boxes;
			vector<int>                   owners;
			for (const MaterialPoint& point : points) {
				if (point.state->body != one && point.state->body != other) continue;
				const auto box = boxOf<Dim>(point);
				if ((box.low - high).maxCoeff() <= 0 && (low - box.high).maxCoeff() <= 0)
					boxes.push_back(box), owners.push_back(point.state->body);
			}
			if (!gimpm::sharingNodes<Dim>(boxes, owners, analysis.grid->origin.template head<Dim>(), h).empty()) found.insert({ one, other });
		}
		return found;
	}
}

bool Sticking::mayBegin(const Analysis& analysis)
{
	const int count = analysis.distributed ? 0 : int(analysis.grid->bodies.size());
	pairs.clear();
	for (int one = -1; one < count; ++one)
		for (int other = one + 1; other < count; ++other)
			if (!known.count({ one, other }) && !haveContact(analysis, one, other)) pairs.insert({ one, other });
	return !pairs.empty();
}

string Sticking::warning(const Analysis& analysis, const vector<MaterialPoint>& points)
{
	const auto found   = analysis.grid->dim == 3 ? pairsThatStick<3>(analysis, points, pairs) : pairsThatStick<2>(analysis, points, pairs);
	const bool isFirst = !std::exchange(hasLooked, true);
	known.insert(found.begin(), found.end());
	if (isFirst || found.empty()) return "";
	const auto& [one, other] = *found.begin();
	const string second = "'" + analysis.grid->nameOfWhole(other) + "'", first = one < 0 ? "" : "'" + analysis.grid->nameOfWhole(one) + "'";
	return (one < 0 ? "points without a name" : "body " + first) + " and body " + second
	        + " begin to share cells, and have no MpmBodyContact between them: from now on they stick to each other. If they are meant to part again, "
	        + (one < 0 ? "fill both by name (mpm.fill(..., body=...)) and give them a contact."
	                   : "add MpmBodyContact(between=(" + first + ", " + second + "), friction=...) to contacts.");
}

} // namespace yade
