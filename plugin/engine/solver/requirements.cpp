// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/requirements.hpp"
#include "core/solvers/multigrid.hpp"
#include "engine/solver/MpmImplicitEngine.hpp"
#include "engine/solver/contacts.hpp"
#include "engine/solver/processes.hpp"
#include <omp.h>
#include <set>

namespace yade {

namespace {
	// Of several engines none may claim a point of another: it would be moved twice.
	void requireOnlyClaim(const MpmImplicitEngine& engine)
	{
		const Scene&                     scene = *engine.scene;
		vector<const MpmImplicitEngine*> others;
		int                              entries = 0;
		for (const auto& listed : scene.engines) {
			const auto* other = dynamic_cast<const MpmImplicitEngine*>(listed.get());
			if (other == &engine) ++entries;
			else if (other && !other->dead)
				others.push_back(other);
		}
		if (entries > 1)
			throw std::invalid_argument(engine.getClassName() + ": the same engine is listed " + std::to_string(entries) + " times in O.engines.");
		for (const auto* other : others)
			for (const MaterialPoint& point : materialPoints(scene, engine.mask))
				if (maskMatches(*(*scene.bodies)[point.id], other->mask))
					throw std::invalid_argument(
					        "Body #" + std::to_string(point.id)
					        + ": two engines with material points in O.engines claim it, with mask = " + std::to_string(engine.mask)
					        + " and " + std::to_string(other->mask) + "; give each body a groupMask that goes with one of them.");
	}

	// A load and a wall would move it in different ways.
	void requireOwnSurfaces(const MpmImplicitEngine& engine)
	{
		for (size_t b = 0; b < engine.boundaries.size(); ++b)
			for (size_t i = 0; i < engine.loads.size(); ++i)
				if (engine.boundaries[b]->surface && engine.boundaries[b]->surface == engine.loads[i]->surface)
					throw std::invalid_argument(
					        "boundaries[" + std::to_string(b) + "] and loads[" + std::to_string(i)
					        + "] have the same MpmSurface: give each its own.");
	}
}

static std::set<Body::id_t> idsOfContacts(const MpmImplicitEngine& engine, const Scene& scene)
{
	std::set<Body::id_t> ids;
	for (const auto& contact : engine.contacts)
		for (const auto& body : bodiesOf(*contact, scene))
			ids.insert(body->id);
	return ids;
}

// Nor a rigid body, which would be moved twice.
static void requireOnlyContact(const MpmImplicitEngine& engine)
{
	for (const auto& listed : engine.scene->engines) {
		const auto* other = dynamic_cast<const MpmImplicitEngine*>(listed.get());
		if (!other || other == &engine || other->dead || other->contacts.empty()) continue;
		const auto own = idsOfContacts(engine, *engine.scene);
		for (const Body::id_t id : idsOfContacts(*other, *engine.scene))
			if (own.count(id))
				throw std::invalid_argument(
				        "Body #" + std::to_string(id)
				        + " is claimed by contacts of two engines; give these MpmContacts masks that go with different bodies.");
	}
}

// What is listed twice would act twice.
template <class T> static void requireOnce(const char* attribute, const vector<shared_ptr<T>>& list)
{
	for (size_t j = 0; j < list.size(); ++j)
		for (size_t i = 0; i < j; ++i)
			if (list[i] == list[j])
				throw std::invalid_argument(
				        string(attribute) + "[" + std::to_string(i) + "] and " + attribute + "[" + std::to_string(j) + "] are the same "
				        + T::staticName() + ", which would act twice: list it once.");
}

void requireCallable(const string& engine)
{
	if (omp_get_level() > 0)
		throw std::invalid_argument(
		        engine + ": inside a ParallelEngine it cannot tell what other engines do with its material points; put it into O.engines itself.");
	if (PyGILState_Check() && Singleton<Omega>::instance().isRunning())
		throw std::runtime_error(engine + ": called while the scene runs in the background; call O.wait() or O.pause() first.");
}

static void requireMultigrid()
{
	const string absence = gimpm::Multigrid::absence();
	if (!absence.empty())
		throw std::invalid_argument(
		        "MpmNewton.linearSolver = 'amg' needs the plugin's library for PETSc, which cannot be opened (" + absence
		        + "). scripts/setup --with-petsc, or the package yade-mpm-petsc, installs it; without it 'auto' comes to the same states.");
}

// YADE's own way to several processes, which cuts the list of bodies and sends forces to and fro.
static void requireNoDecomposition(const Scene& scene)
{
	for (const auto& engine : scene.engines)
		if (engine->label == "sendRecvStatesRunner")
			throw std::invalid_argument(
			        "the scene has been split by yade.mpy (mp.mpirun), which knows nothing of material points: leave that out, and start the script with scripts/run -n N, "
			        "so that N processes share each load step.");
}

// What has not been shown to be right there.
static void requireEqualCells(const MpmImplicitEngine& engine)
{
	if (!engine.grid || engine.grid->refinements.empty()) return;
	string what;
	if (engine.isDynamic()) what = engine.getClassName() + ", as inertia";
	else if (!engine.water.empty())
		what = "water";
	else if (engine.newton->linearSolver == "amg")
		what = "MpmNewton.linearSolver = 'amg'";
	else if (processes()->size() > 1)
		what = "several processes";
	for (size_t b = 0; b < engine.boundaries.size(); ++b)
		if (engine.boundaries[b]->surface) what = "boundaries[" + std::to_string(b) + "].surface";
	if (!what.empty())
		throw std::invalid_argument("MpmGrid.refinements, cells of several sizes, cannot go with " + what + " yet; leave one of the two out.");
}

void requireSettings(const MpmImplicitEngine& engine)
{
	engine.requireAdmissible();
	requireEqualCells(engine);
	if (engine.newton->linearSolver == "amg") requireMultigrid();
	if (engine.maxSplits > 0 && engine.basis != "gimp")
		throw std::invalid_argument(
		        "maxSplits = " + std::to_string(engine.maxSplits) + " needs basis='gimp': with basis='" + engine.basis
		        + "' points have no domains on the grid that could outgrow a cell. Set maxSplits = 0.");
	requireOnce("boundaries", engine.boundaries);
	requireOnce("loads", engine.loads);
	requireOnce("water", engine.water);
	requireOnce("contacts", engine.contacts);
	requireOwnSurfaces(engine);
	for (size_t b = 0; b < engine.boundaries.size() && !engine.isDynamic(); ++b)
		if (engine.boundaries[b]->motion)
			throw std::invalid_argument(
			        "boundaries[" + std::to_string(b)
			        + "].motion is a history in time, which MpmImplicitEngine knows nothing of: take MpmDynamicEngine, or give displacement.");
}

void requireRunnable(const MpmImplicitEngine& engine)
{
	engine.requireAdmissible();
	requireNoDecomposition(*engine.scene);
	requireOnlyClaim(engine);
	if (!engine.contacts.empty()) requireOnlyContact(engine);
	Scene&             scene = *engine.scene;
	std::ostringstream text;
	if (!(scene.dt > 0) || !std::isfinite(scene.dt))
		text << "O.dt = " << scene.dt
		     << " is not admitted: expected a finite number > 0, the load time of one step (with the default loadCurve, 1/80 gives 80 steps).";
	else if (engine.iterPeriod == 1 && scene.timeStepperActive())
		text << "an active TimeStepper among O.engines sets O.dt, which is the load increment of a step: remove it, set its active=False, or run this engine "
		        "every N iterations with iterPeriod=N.";
	else if (scene.isPeriodic)
		text << "a periodic scene (O.periodic) is not supported.";
	else if (scene.time + scene.dt <= engine.loadTime)
		text << "O.time + O.dt = " << scene.time + scene.dt << " is not after the last converged load time " << engine.loadTime
		     << ". After O.resetTime() set loadTime = O.time.";
	else
		return;
	throw std::invalid_argument(engine.getClassName() + ": " + text.str());
}

void requireAny(const vector<MaterialPoint>& points, const MpmImplicitEngine& engine)
{
	if (!points.empty()) return;
	if (materialPoints(*engine.scene).empty())
		throw std::invalid_argument(engine.getClassName() + ": the scene has no material points; add them with O.bodies.append(mpm.fill(...)).");
	throw std::invalid_argument(
	        engine.getClassName() + ": the scene has no material points whose groupMask goes with mask = " + std::to_string(engine.mask) + ".");
}

} // namespace yade
