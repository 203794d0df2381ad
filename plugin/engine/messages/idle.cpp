// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/messages/idle.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/parallel/distribution.hpp"
#include "engine/parallel/processes.hpp"

namespace yade {

namespace {
	bool isNear(const MaterialPoint& p, const std::pair<Vector3r, Vector3r>& box, const string& body, const MpmGrid& grid)
	{
		if (!body.empty() && p.state->body != grid.bodyNamed(body)) return false;
		// Nodes of the cells that it touches.
		const Vector3r reach = p.shape->halfSize + Vector3r::Constant(grid.cellSize);
		return ((p.state->pos + reach - box.first).head(grid.dim).array() > 0).all()
		        && ((box.second - p.state->pos + reach).head(grid.dim).array() > 0).all();
	}

	// Nonzero for each condition that no point is near, wherever the points are.
	vector<int64_t> areFar(const Analysis& analysis, const vector<Listed>& conditions, const vector<MaterialPoint>& points)
	{
		vector<int64_t> isFar;
		for (const Listed& listed : conditions) {
			const auto   box  = listed.condition->extent();
			const string body = listed.condition->onlyOn();
			isFar.push_back(
			        box && std::none_of(points.begin(), points.end(), [&](const auto& p) { return isNear(p, *box, body, *analysis.grid); }));
		}
		holdersOf(analysis)->smallest(isFar.data(), int(isFar.size()));
		return isFar;
	}
}

string idleConditions(const Analysis& analysis, const vector<MaterialPoint>& points, const std::function<bool(const MpmCondition&)>& isMeant)
{
	const auto conditions = analysis.conditions();
	const auto isFar      = areFar(analysis, conditions, points);
	string     text;
	for (size_t c = 0; c < conditions.size(); ++c)
		if (isMeant(*conditions[c].condition)) text += conditions[c].condition->idleness(conditions[c].name(), !isFar[c]);
	return text;
}

} // namespace yade
