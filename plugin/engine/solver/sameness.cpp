// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/sameness.hpp"
#include "core/base/checksum.hpp"
#include "core/base/sentence.hpp"
#include "engine/points/newPoints.hpp"
#include "engine/solver/MpmImplicitEngine.hpp"
#include "yade_api/serialization.hpp"
#include <sstream>

namespace yade {

namespace {
	std::uint64_t checksum(const vector<MaterialPoint>& points, size_t begin)
	{
		gimpm::Checksum sum;
		vector<Real>    numbers;
		const auto      add = [&](const auto& values) { numbers.insert(numbers.end(), values.data(), values.data() + values.size()); };
		for (size_t p = begin; p < points.size(); ++p) {
			const MpmState& s = *points[p].state;
			numbers           = { Real(points[p].id), s.volume0, Real(points[p].material->id) };
			add(Vector3r(s.pos)), add(s.force), add(points[p].shape->halfSize), add(s.defGrad), add(s.elasticStrain);
			for (const auto* named : { &s.internals, &s.parameters })
				for (const auto& [name, value] : *named)
					numbers.push_back(value);
			sum.mix(numbers);
		}
		return sum.take();
	}

	// Of everything that goes into it, as it is saved.
	template <class... Parts> std::uint64_t checksumOf(const Parts&... parts)
	{
		std::ostringstream stream(std::ios::binary);
		{
			boost::archive::binary_oarchive archive(stream);
			(archive << ... << parts);
		}
		return std::hash<string>()(stream.str());
	}

	std::uint64_t settingsOf(const MpmImplicitEngine& engine)
	{
		const Scene& scene = *engine.scene;
		return checksumOf(
		        engine.grid, engine.basis, engine.fBar, engine.boundaries, engine.ghost, engine.newton, engine.mask, engine.gravity, engine.loadCurve,
		        engine.gravityCurve, engine.loadTime, engine.stepPart, engine.lastDisplacements, engine.lastLoadIncrement, scene.dt, scene.time);
	}

	const char* const remedy = ". The script must do the same in all of them, in the same order: random numbers need a seed, and files the same content.";

	string startOf(const MpmImplicitEngine& engine, const char* what)
	{
		return gimpm::sentence(engine.getClassName(), ": the processes hold different ", what, " in iteration ", engine.scene->iter);
	}
}

void requireSame(const gimpm::Processes& all, const MpmImplicitEngine& engine, const vector<MaterialPoint>& points, size_t begin)
{
	const bool  areSameBodies = all.haveSame(engine.scene->bodies->size()), areSamePoints = all.haveSame(checksum(points, begin));
	const bool  areSameSettings = all.haveSame(settingsOf(engine));
	const char* what            = !areSameBodies ? "numbers of bodies" : !areSamePoints ? "material points" : !areSameSettings ? "settings" : nullptr;
	if (what) throw std::runtime_error(startOf(engine, what) + remedy);
}

void requireSame(const gimpm::Processes& all, const NewPoints& points)
{
	if (!all.haveSame(points.checksum())) throw std::runtime_error(gimpm::sentence("the processes add different material points", remedy));
}

vector<const MpmMaterial*> materialsOfAll(const Scene& scene, const vector<MaterialPoint>& points, const gimpm::Processes& all)
{
	vector<int64_t> isMissing(scene.materials.size(), 1);
	for (const MaterialPoint& point : points)
		isMissing[point.materialIndex(scene)] = 0;
	all.smallest(isMissing.data(), int(isMissing.size()));
	vector<const MpmMaterial*>   materials;
	vector<shared_ptr<Material>> values;
	for (size_t m = 0; m < isMissing.size(); ++m)
		if (!isMissing[m]) {
			values.push_back(scene.materials[m]);
			materials.push_back(dynamic_cast<const MpmMaterial*>(scene.materials[m].get()));
		}
	if (all.haveSame(checksumOf(values))) return materials;
	throw std::runtime_error("the processes hold different values of materials. The script must do the same in all of them.");
}

} // namespace yade
