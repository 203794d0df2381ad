// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/conditions/bodies/layers.hpp"
#include "core/base/sentence.hpp"
#include "engine/conditions/bodies/contact_records.hpp"
#include <set>

namespace yade {

static bool meet(const Analysis& analysis, const string& one, const string& other)
{
	const auto all = analysis.conditions();
	return std::any_of(all.begin(), all.end(), [&](const Listed& listed) { return listed.condition->isBetween(one, other); });
}

bool meet(const Analysis& analysis, int one, int other)
{
	if (one < 0 || other < 0 || one == other) return false;
	return meet(analysis, analysis.grid->nameOfWhole(one), analysis.grid->nameOfWhole(other));
}

vector<int> bodyLayers(const Analysis& analysis)
{
	if (!analysis.bodiesMeet()) return {};
	std::set<int> alone;
	for (const Listed& listed : analysis.conditions())
		if (const string name = listed.condition->onlyOn(); !name.empty()) alone.insert(analysis.grid->bodyNamed(name));
	vector<int> layers { 0 };
	for (int body = 0; body < int(analysis.grid->bodies.size()); ++body) {
		std::set<int> taken;
		for (int other = -1; other < body; ++other)
			if (alone.count(body) || alone.count(other) || meet(analysis, body, other)) taken.insert(layers[other + 1]);
		int layer = 0;
		while (taken.count(layer))
			++layer;
		layers.push_back(layer);
	}
	return layers;
}

int layerOf(const Analysis& analysis, const string& body)
{
	const auto layers = bodyLayers(analysis);
	return body.empty() || layers.empty() ? -1 : layers[analysis.grid->bodyNamed(body) + 1];
}

string bodiesThereAre(const MpmGrid& grid)
{
	string known;
	for (const auto& body : grid.bodies)
		known += (known.empty() ? "" : ", ") + body->name;
	return known;
}

void requireOwnNodes(const Analysis& analysis, const string& body, const string& name)
{
	if (body.empty()) return;
	const string known = bodiesThereAre(*analysis.grid), given = name + ".body = '" + body + "'";
	if (analysis.grid->bodyNamed(body) < 0)
		throw std::invalid_argument(gimpm::sentence(
		        given, ": no body is called that; ",
		        known.empty() ? "MpmGrid.bodies is empty: fill it with mpm.fill(..., body='" + body + "') and the MpmGrid of the engine."
		                      : "there are " + known + "."));
	if (meet(analysis, body, body))
		throw std::invalid_argument(
		        given + " names a body that has a contact with itself: it may fall into parts, which have nodes of their own. Leave body out.");
	if (!analysis.bodiesMeet())
		throw std::invalid_argument(
		        given
		        + " names one of bodies that stick to each other, as there is no MpmBodyContact among contacts: they share their nodes, and what acts on one acts "
		          "on all. Leave body out, or give contacts.");
}

} // namespace yade
