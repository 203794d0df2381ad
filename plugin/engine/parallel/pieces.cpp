// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/parallel/pieces.hpp"
#include <algorithm>
#include <sstream>

namespace yade {

namespace {
	const string key = "mpm.pieces=";

	bool isKeptIn(const string& tag) { return tag.compare(0, key.size(), key) == 0; }
}

Pieces Pieces::of(const Scene& scene)
{
	const auto tag = std::find_if(scene.tags.begin(), scene.tags.end(), isKeptIn);
	if (tag == scene.tags.end()) return {};
	Pieces             p;
	std::istringstream text(tag->substr(key.size()));
	text >> p.count >> p.number >> p.bodies >> p.gap;
	const bool areThose = int(scene.bodies->size()) >= p.bodies && !(p.gap < p.bodies && (*scene.bodies)[p.gap]);
	return areThose ? p : Pieces();
}

void Pieces::note(Scene& scene, const gimpm::Processes& all)
{
	scene.tags.erase(std::remove_if(scene.tags.begin(), scene.tags.end(), isKeptIn), scene.tags.end());
	if (all.size() == 1) return;
	const int bodies = int(scene.bodies->size());
	int       gap    = 0;
	while (gap < bodies && (*scene.bodies)[gap])
		++gap;
	std::ostringstream text;
	text << key << all.size() << ' ' << all.rank() << ' ' << bodies << ' ' << gap;
	scene.tags.push_back(text.str());
}

void provideGaps(Scene& scene, size_t places)
{
	if (scene.bodies->size() >= places) return;
	const auto last = Body::id_t(places) - 1;
	scene.bodies->insertAtId(shared_ptr<Body>(new Body), last);
	scene.bodies->erase(last, false);
}

} // namespace yade
