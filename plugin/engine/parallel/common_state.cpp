// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/parallel/common_state.hpp"
#include "core/base/checksum.hpp"
#include "core/base/sentence.hpp"
#include "core/parallel/together.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/grid/newPoints.hpp"
#include "engine/parallel/archived.hpp"
#include "yade_api/bodies.hpp"

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

	// Checksum of all attributes, and of the position and the velocity that belong to YADE's State.
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

	// Checksum of the settings with all conditions, pointers of each list after the other.
	std::uint64_t settingsOf(const Analysis& engine)
	{
		const Scene&                     scene = engine.sceneOfRun();
		vector<shared_ptr<MpmCondition>> conditions;
		string                           names;
		for (const Listed& listed : engine.conditions())
			conditions.push_back(listed.condition), names += listed.name();
		return checksumOf(
		        engine.grid, engine.basis, engine.domains, engine.fBar, engine.pressureRelaxation, engine.nonlocalLength, names, conditions,
		        engine.ghost, engine.newton, engine.mask, engine.maxSplits, engine.gravity, engine.loadCurve, engine.gravityCurve, engine.loadTime,
		        engine.stepPart, engine.lastDisplacements, engine.lastLoadIncrement, scene.dt, scene.time);
	}

	vector<shared_ptr<Body>> rigidBodiesOf(const Analysis& engine)
	{
		vector<shared_ptr<Body>> all;
		for (const Listed& listed : engine.conditions()) {
			const auto own = listed.condition->rigidBodies(engine.sceneOfRun());
			all.insert(all.end(), own.begin(), own.end());
		}
		return all;
	}

	// Checksum of the friction of the rigid bodies that may touch the soil. Their shapes have a colour by chance,
	// and are not compared.
	std::uint64_t frictionOf(const Analysis& engine)
	{
		vector<shared_ptr<Material>> materials;
		for (const auto& body : rigidBodiesOf(engine))
			materials.push_back(body->material);
		return checksumOf(materials);
	}

	// Checksum of their poses and velocities.
	std::uint64_t motionOf(const Analysis& engine)
	{
		vector<Real> numbers;
		const auto   take = [&](const State& s) {
                        for (const Vector3r& v : { Vector3r(s.pos), s.vel, s.angVel })
                                numbers.insert(numbers.end(), v.data(), v.data() + 3);
                        const Quaternionr ori = s.ori;
                        numbers.insert(numbers.end(), ori.coeffs().data(), ori.coeffs().data() + 4);
		};
		for (const auto& body : rigidBodiesOf(engine)) {
			take(*body->state);
			const auto clump = body->isClumpMember() ? bodyAt(engine.sceneOfRun(), body->clumpId) : nullptr;
			if (clump) take(*clump->state);
		}
		gimpm::Checksum sum;
		sum.mix(numbers);
		return sum.take();
	}

	const char* const remedy = ". The script must do the same in all of them, in the same order: random numbers need a seed, and files the same content.";

	string startOf(const Analysis& engine, const char* what)
	{
		return gimpm::sentence(engine.className(), ": the processes have different ", what, " in iteration ", engine.sceneOfRun().iter);
	}
}

void requireSame(const gimpm::Processes& all, const Analysis& engine, const vector<MaterialPoint>& points, size_t begin)
{
	const bool  areSameBodies = all.haveSame(engine.sceneOfRun().bodies->size()), areSamePoints = all.haveSame(checksum(points, begin));
	const bool  areSameSettings = all.haveSame(settingsOf(engine) ^ engine.checksumInTime()), moveAlike = all.haveSame(motionOf(engine));
	const bool  rubAlike = all.haveSame(frictionOf(engine));
	const char* what     = !areSameBodies ? "numbers of bodies"
	            : !areSamePoints          ? "material points"
	            : !areSameSettings        ? "settings"
	            : !rubAlike               ? "materials of rigid bodies"
	            : !moveAlike              ? "positions or velocities of rigid bodies"
	                                      : nullptr;
	if (what) throw std::runtime_error(startOf(engine, what) + remedy);
}

void requireSame(const gimpm::Processes& all, const NewPoints& points)
{
	if (!all.haveSame(points.checksum())) throw std::runtime_error(gimpm::sentence("the processes add different material points", remedy));
}

void requireSameAnswers(const gimpm::Processes& all, const Analysis& engine)
{
	vector<shared_ptr<MpmCondition>> asked;
	string                           what, classes;
	for (const Listed& listed : engine.conditions()) {
		if (!listed.condition->hasQuestions()) continue;
		if (asked.empty()) what = listed.condition->answers(), classes = listed.condition->getClassName();
		asked.push_back(listed.condition);
	}
	if (asked.empty() || gimpm::haveSame(all, [&] { return checksumOf(asked); })) return;
	throw std::runtime_error(startOf(engine, what.c_str()) + ". Functions of " + classes + " must answer the same in all of them.");
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
	throw std::runtime_error("the processes have different values of materials. The script must do the same in all of them.");
}

} // namespace yade
