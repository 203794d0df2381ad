// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/analysis/movers.hpp"
#include "core/base/sentence.hpp"
#include "engine/analysis/analysis.hpp"
#include "yade_api/bodies.hpp"
#include "yade_api/serialization.hpp"
#include <sstream>

namespace yade {

namespace {
	// Text of a saved object. This way needs neither the layout of a class, which differs from release to release,
	// nor Python, which this thread must not wait for.
	string saved(const shared_ptr<Serializable>& object)
	{
		std::ostringstream text;
		{
			boost::archive::xml_oarchive archive(text, boost::archive::no_header);
			archive << boost::serialization::make_nvp("object", object);
		}
		return text.str();
	}

	int maskOf(const shared_ptr<Engine>& integrator)
	{
		const string text = saved(integrator), before = "<mask>";
		const size_t at = text.find(before);
		return at == string::npos ? 0 : std::stoi(text.substr(at + before.size()));
	}

	constexpr bool meansAll(int mask) { return mask <= 0; }

	[[noreturn]] void refuseMoved(const MaterialPoint& point, const string& engine, const string& why)
	{
		throw std::invalid_argument(gimpm::sentence(
		        engine, ": body #", point.id, ", a material point", why,
		        ", is moved along its velocity by a NewtonIntegrator, too, as that does with all bodies that its mask means: give material points and grains different groupMasks, and "
		        "that of the grains to the integrator, as in NewtonIntegrator(mask=1) with groupMask = 2 for the points."));
	}

	// Place among O.engines of what is alive; -1: there is none.
	int placeOf(const char* name, const Scene& scene)
	{
		for (size_t i = 0; i < scene.engines.size(); ++i)
			if (!scene.engines[i]->dead && scene.engines[i]->getClassName() == name) return int(i);
		return -1;
	}
}

Movers::Movers(const Scene& scene)
{
	for (const auto& engine : scene.engines) {
		if (engine->dead) continue;
		const string name = engine->getClassName();
		if (name == "NewtonIntegrator") masks.push_back(maskOf(engine));
		if (name == "ParallelEngine" && saved(engine).find("NewtonIntegrator") != string::npos)
			throw std::invalid_argument(
			        "a NewtonIntegrator inside a ParallelEngine: what it moves cannot be told from there, and would be moved twice; put it into O.engines itself.");
	}
}

bool Movers::move(const Body& body) const
{
	return std::any_of(masks.begin(), masks.end(), [&](int mask) { return meansAll(mask) || maskMatches(body, mask); });
}

void Movers::requireOthers(const vector<MaterialPoint>& points, const Scene& scene, bool isDynamic) const
{
	if (masks.empty()) return;
	const BodiesLock lock(scene);
	for (const MaterialPoint& point : points) {
		if (!isDynamic && point.state->vel.isZero(0)) continue;
		if (!scene.bodies->exists(point.id) || !move(*(*scene.bodies)[point.id])) continue;
		if (isDynamic) refuseMoved(point, "MpmDynamicEngine", "");
		refuseMoved(point, "MpmImplicitEngine", gimpm::sentence(" with the velocity (", point.state->vel.transpose(), ")"));
	}
}

void requireExchange(const Body& body, const Scene& scene)
{
	const string what  = "Body #" + std::to_string(body.id);
	const int    reset = placeOf("ForceResetter", scene), newton = placeOf("NewtonIntegrator", scene);
	const auto   isSelf = [](const auto& engine) { return dynamic_cast<const Analysis*>(engine.get()) != nullptr; };
	const int    self   = int(std::find_if(scene.engines.begin(), scene.engines.end(), isSelf) - scene.engines.begin());
	if (reset < 0)
		throw std::invalid_argument(
		        what
		        + " is free to move and gets the forces of the soil, but O.engines has no ForceResetter: forces of all iterations would add up. Put one in front.");
	if (!(reset < self && self < newton))
		throw std::invalid_argument(
		        what
		        + " is free to move and gets the forces of the soil: the engine of its contact must stand behind ForceResetter and before NewtonIntegrator in O.engines.");
	const State& state     = *body.state;
	const auto   hasFree   = [&](unsigned dofs) { return (state.blockedDOFs & dofs) != dofs; };
	const bool   canShift  = hasFree(State::DOF_X | State::DOF_Y | State::DOF_Z);
	const bool   canTurn   = hasFree(State::DOF_RX | State::DOF_RY | State::DOF_RZ);
	const auto   isUsable  = [](Real x) { return x > 0 && std::isfinite(x); };
	const bool   hasTurned = isUsable(state.inertia[0]) && isUsable(state.inertia[1]) && isUsable(state.inertia[2]);
	if (canShift && !isUsable(state.mass))
		throw std::invalid_argument(gimpm::sentence(
		        what, " is free to move, but its mass is ", state.mass,
		        " kg: expected a finite number > 0. Give its material a density, or block it (dynamic=False)."));
	if (canTurn && !hasTurned)
		throw std::invalid_argument(gimpm::sentence(
		        what, " is free to turn, but its inertia is (", state.inertia.transpose(),
		        ") kg m2: expected finite numbers > 0. Give its material a density, or block its rotations (blockedDOFs='XYZ')."));
}

} // namespace yade
