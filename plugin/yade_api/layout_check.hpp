// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Does YADE, as it runs, have the layout that this folder declares?
//
// Objects are made by YADE's factory and their attributes are set by name by YADE's code; then they are read as
// declared here. A member that sits elsewhere shows another value.
#include "yade_api/yade_api.hpp"
#include <functional>
#include <malloc.h>

namespace yade {

class LayoutCheck {
public:
	using Create = std::function<shared_ptr<Factorable>(const string& className)>;

	explicit LayoutCheck(Create create_) : create(std::move(create_)) { }

	// Sizes of all declared classes, and their attributes of plain types. Calls no function of YADE but virtual
	// ones and the given one, so it can run before anything is known about the libraries.
	void checkSizesAndScalars()
	{
		checkScene();
		checkBody();
		checkEngines();
	}

	const vector<string>& errors() const { return found; }

	// An object made by YADE, of a class that is declared with the right size.
	template <class T> shared_ptr<T> make(const char* className = T::staticName())
	{
		const shared_ptr<Factorable>   object = create(className);
		size_t                         size   = malloc_usable_size(object.get()); // rounded up to 8 modulo 16
		vector<shared_ptr<Factorable>> others; // sometimes a piece of memory is 16 bytes larger than needed, but not always
		while (size >= sizeof(T) + 16 && others.size() < 20) {
			others.push_back(create(className));
			size = std::min(size, malloc_usable_size(others.back().get()));
		}
		require(sizeof(T) <= size && size < sizeof(T) + 16, string("size of ") + className);
		return boost::static_pointer_cast<T>(object);
	}

	template <class T, class Member> void require(T& object, const char* attribute, const Member& member, const Member& value)
	{
		object.pySetAttr(attribute, py::object(value));
		require(member == value, string(T::staticName()) + "." + attribute);
	}

	void require(bool isSo, const string& what)
	{
		if (!isSo) found.push_back(what);
	}

private:
	void checkScene()
	{
		const auto scene = make<Scene>();
		require(*scene, "dt", scene->dt, 0.125);
		require(*scene, "iter", scene->iter, 77L);
		require(*scene, "subStepping", scene->subStepping, true);
		require(*scene, "subStep", scene->subStep, 5);
		require(*scene, "time", scene->time, 3.5);
		require(*scene, "speed", scene->speed, 4.5);
		require(*scene, "stopAtIter", scene->stopAtIter, 99L);
		require(*scene, "stopAtTime", scene->stopAtTime, 9.5);
		require(*scene, "isPeriodic", scene->isPeriodic, true);
		require(*scene, "trackEnergy", scene->trackEnergy, true);
		require(*scene, "doSort", scene->doSort, true);
		require(*scene, "selectedBody", scene->selectedBody, 42);
#ifdef YADE_API_MPI
		require(*scene, "subdomain", scene->subdomain, 3);
#endif
	}

	void checkBody()
	{
		const auto body = make<Body>();
		require(*body, "id", body->id, 11);
#ifndef YADE_API_MASK_BITS // otherwise YADE converts it only after `import yade`, and its neighbours say enough
		require(*body, "groupMask", body->groupMask, 6);
#endif
		require(*body, "flags", body->flags, 9);
#ifdef YADE_API_MPI
		require(*body, "subdomain", body->subdomain, 2);
#endif
		require(*body, "clumpId", body->clumpId, 8);
		require(*body, "iterBorn", body->iterBorn, 12345L);
		require(*body, "timeBorn", body->timeBorn, 6.25);

		const auto state = make<State>();
		require(*state, "mass", state->mass, 2.5);
		require(*state, "blockedDOFs", state->blockedDOFs, 5u);
		require(*state, "isDamped", state->isDamped, false);
		require(*state, "densityScaling", state->densityScaling, 0.75);
		require(&state->pos == &state->se3.position && &state->ori == &state->se3.orientation, "State.se3");

		const auto material = make<Material>();
		require(*material, "id", material->id, 21);
		require(*material, "label", material->label, string("some name"));
		require(*material, "density", material->density, 777.);

		const auto shape = make<Shape>();
		require(*shape, "wire", shape->wire, true);
		require(*shape, "highlight", shape->highlight, true);
		const auto sphere = make<Sphere>();
		require(*sphere, "radius", sphere->radius, 0.375);
		make<Box>();
		make<Facet>();
		const auto wall = make<Wall>();
		require(*wall, "sense", wall->sense, -1);
		require(*wall, "axis", wall->axis, 2);

		const auto frictional = make<FrictMat>();
		require(*static_cast<ElastMat*>(frictional.get()), "young", frictional->young, 7.5);
		require(*static_cast<ElastMat*>(frictional.get()), "poisson", frictional->poisson, 0.3125);
		require(*frictional, "frictionAngle", frictional->frictionAngle, 0.4375);
	}

	void checkEngines()
	{
		const auto engine = make<GlobalEngine>();
		require(*static_cast<Engine*>(engine.get()), "dead", engine->dead, true);
		require(*static_cast<Engine*>(engine.get()), "ompThreads", engine->ompThreads, 17);
		require(*static_cast<Engine*>(engine.get()), "label", engine->label, string("someName"));

		const auto periodic = make<PeriodicEngine>();
		require(*periodic, "virtPeriod", periodic->virtPeriod, 0.5);
		require(*periodic, "realPeriod", periodic->realPeriod, 0.25);
		require(*periodic, "iterPeriod", periodic->iterPeriod, 7L);
		require(*periodic, "nDo", periodic->nDo, 8L);
		require(*periodic, "initRun", periodic->initRun, true);
		require(*periodic, "firstIterRun", periodic->firstIterRun, 9L);
		require(*periodic, "virtLast", periodic->virtLast, 1.5);
		require(*periodic, "realLast", periodic->realLast, 2.5);
		require(*periodic, "iterLast", periodic->iterLast, 10L);
		require(*periodic, "nDone", periodic->nDone, 11L);
	}

	Create         create;
	vector<string> found;
};

inline string joined(const vector<string>& items)
{
	string text;
	for (const string& item : items)
		text += (text.empty() ? "" : ", ") + item;
	return text;
}

// All checks, for use after `import yade` when Python can convert vectors and objects: what is wrong, one entry each.
vector<string> findLayoutErrors();

} // namespace yade
