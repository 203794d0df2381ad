// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/sameness.hpp"
#include "core/base/sentence.hpp"
#include "engine/solver/MpmImplicitEngine.hpp"
#include "yade_api/serialization.hpp"
#include <cstring>
#include <sstream>

namespace yade {

namespace {
	class Checksum {
	public:
		void mix(Real number)
		{
			std::uint64_t word;
			std::memcpy(&word, &number, sizeof word);
			sum = (sum ^ word) * 0x9E3779B97F4A7C15u;
			sum ^= sum >> 29;
		}
		template <class V> void mixAll(const V& numbers)
		{
			for (int i = 0; i < int(numbers.size()); ++i)
				mix(numbers.data()[i]);
		}
		std::uint64_t value() const { return sum; }

	private:
		std::uint64_t sum = 1;
	};

	std::uint64_t checksum(const vector<MaterialPoint>& points, size_t begin)
	{
		Checksum sum;
		for (size_t p = begin; p < points.size(); ++p) {
			const MpmState& s = *points[p].state;
			sum.mix(points[p].id), sum.mix(s.volume0), sum.mix(points[p].material->id);
			sum.mixAll(Vector3r(s.pos)), sum.mixAll(s.force), sum.mixAll(points[p].shape->halfSize);
			sum.mixAll(s.defGrad), sum.mixAll(s.elasticStrain);
			for (const auto& internal : s.internals)
				sum.mix(internal.second);
		}
		return sum.value();
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
	if (what)
		throw std::runtime_error(
		        startOf(engine, what)
		        + ". The script must do the same in all of them, in the same order: random numbers need a seed, and files the same content.");
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
