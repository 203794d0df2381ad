// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/sameness.hpp"
#include "core/base/checksum.hpp"
#include "core/base/sentence.hpp"
#include "core/parallel/together.hpp"
#include "engine/points/newPoints.hpp"
#include "engine/solver/MpmDynamicEngine.hpp"
#include "yade_api/serialization.hpp"
#include <sstream>

namespace yade {

namespace {
	// An attribute, of whatever kind: a number, a vector or tensor, or numbers by their names.
	template <class T> void append(const T& value, vector<Real>& numbers)
	{
		if constexpr (std::is_arithmetic_v<T>) numbers.push_back(value);
		else if constexpr (std::is_base_of_v<Eigen::MatrixBase<T>, T>)
			numbers.insert(numbers.end(), value.data(), value.data() + value.size());
		else
			for (const auto& [name, number] : value)
				numbers.push_back(number);
	}

	// Of all attributes, and of the place and the velocity that belong to YADE's State.
	std::uint64_t checksum(const vector<MaterialPoint>& points, size_t begin)
	{
		gimpm::Checksum sum;
		vector<Real>    numbers;
		for (size_t p = begin; p < points.size(); ++p) {
			const MaterialPoint& point = points[p];
			numbers                    = { Real(point.id), Real(point.material->id) };
			append(Vector3r(point.state->pos), numbers), append(point.state->vel, numbers);
			MpmState::attributes([&](const char*, auto member, auto&&...) { append((*point.state).*member, numbers); });
			MpmPoint::attributes([&](const char*, auto member, auto&&...) { append((*point.shape).*member, numbers); });
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
		        engine.grid, engine.basis, engine.fBar, engine.boundaries, engine.loads, engine.water, engine.contacts, engine.ghost, engine.newton,
		        engine.mask, engine.maxSplits, engine.gravity, engine.loadCurve, engine.gravityCurve, engine.loadTime, engine.stepPart,
		        engine.lastDisplacements, engine.lastLoadIncrement, scene.dt, scene.time);
	}

	// Of the rigid bodies that may touch the soil: with which friction. Their shapes have a colour by chance, and are not compared.
	std::uint64_t frictionOf(const MpmImplicitEngine& engine)
	{
		vector<shared_ptr<Material>> materials;
		for (const auto& contact : engine.contacts)
			for (const auto& body : bodiesOf(*contact, *engine.scene))
				materials.push_back(body->material);
		return checksumOf(materials);
	}

	// Where they are, and how they move.
	std::uint64_t motionOf(const MpmImplicitEngine& engine)
	{
		vector<Real> numbers;
		const auto   take = [&](const State& s) {
                        for (const Vector3r& v : { Vector3r(s.pos), s.vel, s.angVel })
                                numbers.insert(numbers.end(), v.data(), v.data() + 3);
                        const Quaternionr ori = s.ori;
                        numbers.insert(numbers.end(), ori.coeffs().data(), ori.coeffs().data() + 4);
		};
		const BodyContainer& all = *engine.scene->bodies;
		for (const auto& contact : engine.contacts)
			for (const auto& body : bodiesOf(*contact, *engine.scene)) {
				take(*body->state);
				if (body->isClumpMember() && all.exists(body->clumpId)) take(*all[body->clumpId]->state);
			}
		gimpm::Checksum sum;
		sum.mix(numbers);
		return sum.take();
	}

	// Of inertia, if it has that.
	std::uint64_t settingsInTimeOf(const MpmImplicitEngine& engine)
	{
		const auto* e = dynamic_cast<const MpmDynamicEngine*>(&engine);
		return e ? checksumOf(e->scheme, e->beta, e->gamma, e->rhoInfinity, e->timeTolerance, e->absorbing, e->rayleigh) : 0;
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
	const bool  areSameSettings = all.haveSame(settingsOf(engine) ^ settingsInTimeOf(engine)), moveAlike = all.haveSame(motionOf(engine));
	const bool  rubAlike = all.haveSame(frictionOf(engine));
	const char* what     = !areSameBodies ? "numbers of bodies"
	            : !areSamePoints          ? "material points"
	            : !areSameSettings        ? "settings"
	            : !rubAlike               ? "materials of rigid bodies"
	            : !moveAlike              ? "places or velocities of rigid bodies"
	                                      : nullptr;
	if (what) throw std::runtime_error(startOf(engine, what) + remedy);
}

void requireSame(const gimpm::Processes& all, const NewPoints& points)
{
	if (!all.haveSame(points.checksum())) throw std::runtime_error(gimpm::sentence("the processes add different material points", remedy));
}

void requireSameWater(const gimpm::Processes& all, const MpmImplicitEngine& engine)
{
	if (engine.water.empty() || gimpm::haveSame(all, [&] { return checksumOf(engine.water); })) return;
	throw std::runtime_error(startOf(engine, "pressures of water") + ". MpmWater.pressure must answer the same in all of them.");
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
