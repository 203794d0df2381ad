// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/messages/requirements.hpp"
#include "core/solvers/multigrid.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/parallel/processes.hpp"
#include "yade_api/bodies.hpp"
#include <algorithm>
#include <omp.h>
#include <set>

namespace yade {

namespace {
	// Refuses an engine that claims a point of another engine: the point would be moved twice.
	void requireOnlyClaim(const Analysis& engine)
	{
		const Scene&            scene = engine.sceneOfRun();
		vector<const Analysis*> others;
		int                     entries = 0;
		for (const auto& listed : scene.engines) {
			const auto* other = dynamic_cast<const Analysis*>(listed.get());
			if (other == &engine) ++entries;
			else if (other && !listed->dead)
				others.push_back(other);
		}
		if (entries > 1)
			throw std::invalid_argument(engine.className() + ": the same engine is listed " + std::to_string(entries) + " times in O.engines.");
		if (others.empty()) return;
		const auto       points = materialPoints(scene, engine.mask);
		const BodiesLock lock(scene);
		for (const auto* other : others)
			for (const MaterialPoint& point : points)
				if (scene.bodies->exists(point.id) && maskMatches(*(*scene.bodies)[point.id], other->mask))
					throw std::invalid_argument(
					        "Body #" + std::to_string(point.id)
					        + ": two engines with material points in O.engines claim it, with mask = " + std::to_string(engine.mask)
					        + " and " + std::to_string(other->mask) + "; give each body a groupMask that goes with one of them.");
	}

	// Refuses conditions that are listed twice, which would act twice, and two that move the same surface in
	// different ways.
	void requireOnce(const vector<Listed>& all)
	{
		for (size_t j = 0; j < all.size(); ++j)
			for (size_t i = 0; i < j; ++i) {
				const auto names = all[i].name() + " and " + all[j].name();
				if (all[i].condition == all[j].condition)
					throw std::invalid_argument(
					        names + " are the same " + all[i].condition->getClassName() + ", which would act twice: list it once.");
				const auto* surface = all[i].condition->ownSurface();
				if (surface && surface == all[j].condition->ownSurface())
					throw std::invalid_argument(names + " have the same MpmSurface, which would move twice: give each its own.");
			}
	}

	std::set<Body::id_t> idsOfRigidBodies(const Analysis& engine, const Scene& scene)
	{
		std::set<Body::id_t> ids;
		for (const Listed& listed : engine.conditions())
			for (const auto& body : listed.condition->rigidBodies(scene))
				ids.insert(body->id);
		return ids;
	}
}

// Nor a rigid body, which would be moved twice.
static void requireOnlyContact(const Analysis& engine)
{
	for (const auto& listed : engine.sceneOfRun().engines) {
		const auto* other = dynamic_cast<const Analysis*>(listed.get());
		if (!other || other == &engine || listed->dead) continue;
		const auto own = idsOfRigidBodies(engine, engine.sceneOfRun());
		for (const Body::id_t id : idsOfRigidBodies(*other, engine.sceneOfRun()))
			if (own.count(id))
				throw std::invalid_argument(
				        "Body #" + std::to_string(id)
				        + " is claimed by contacts of two engines; give these MpmContacts masks that go with different bodies.");
	}
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

// Refuses features that have not been shown to be right there.
static void requireEqualCells(const Analysis& engine)
{
	if (!engine.grid || engine.grid->hasEqualCells()) return;
	string what;
	if (engine.newton->linearSolver == "amg") what = "MpmNewton.linearSolver = 'amg'";
	else if (processes()->size() > 1)
		what = "several processes";
	for (const Listed& listed : engine.conditions())
		if (const string own = listed.condition->needsEqualCells(listed.name()); !own.empty()) what = own;
	if (!what.empty()) throw std::invalid_argument(engine.grid->severalSizes() + " cannot go with " + what + " yet; leave one of the two out.");
}

// Refuses features that have not been shown to be right with contact between bodies of points.
static void requireOneBody(const Analysis& engine)
{
	string what, meets;
	for (const Listed& listed : engine.conditions())
		if (listed.condition->partsBodies()) meets = listed.name() + ", an " + listed.condition->getClassName() + ",";
	if (meets.empty()) return;
	if (engine.grid && !engine.grid->period.isZero(0)) what = "MpmGrid.period, a grid that repeats itself";
	for (const Listed& listed : engine.conditions())
		if (const string own = listed.condition->needsOneBody(listed.name()); !own.empty()) what = own;
	if (!what.empty()) throw std::invalid_argument(meets + " cannot go with " + what + " yet; leave one of the two out.");
}

static void requireGhost(const Analysis& engine)
{
	if (engine.ghost->memory > 0 && (engine.isDynamic() || !engine.newton->predictor))
		throw std::invalid_argument(
		        "MpmGhost.memory = " + std::to_string(engine.ghost->memory) + " is of steps that are predicted from the last one: with "
		        + (engine.isDynamic() ? engine.className() : "MpmNewton.predictor = False") + " 0 is admitted.");
	if (engine.ghost->workTolerance < 1 && engine.isDynamic())
		throw std::invalid_argument(
		        "MpmGhost.workTolerance = " + std::to_string(engine.ghost->workTolerance) + " is of static steps: with " + engine.className()
		        + ", where inertia bears what is out of balance, 1 is admitted.");
	if (engine.ghost->where == "aggregates" && processes()->size() > 1)
		throw std::invalid_argument(
		        "MpmGhost.where = 'aggregates' cannot go with several processes yet, none of which knows how all cells are filled: 'boundary', or one process, is admitted.");
}

static void requireNonlocal(const Analysis& engine)
{
	if (engine.nonlocalLength == 0) return;
	string what;
	if (engine.isExplicit()) what = "scheme = 'explicit'";
	else if (processes()->size() > 1)
		what = "several processes";
	else if (engine.grid && !engine.grid->hasEqualCells())
		what = engine.grid->severalSizes();
	else if (engine.grid && engine.grid->axisymmetric)
		what = "MpmGrid.axisymmetric";
	const string length = engine.className() + ".nonlocalLength = " + std::to_string(engine.nonlocalLength);
	if (!what.empty()) throw std::invalid_argument(length + " cannot go with " + what + " yet; leave one of the two out.");
	if (engine.grid && engine.nonlocalLength < engine.grid->cellSize)
		throw std::invalid_argument(
		        length + " is not admitted: expected 0, or at least the cellSize = " + std::to_string(engine.grid->cellSize)
		        + " m, as cells cannot carry a narrower band. It is a length of the soil, not of the grid.");
}

static void requireRelaxation(const Analysis& engine)
{
	if (engine.pressureRelaxation && !engine.fBar)
		throw std::invalid_argument(
		        engine.className()
		        + ".pressureRelaxation = True is of fBar=True, which leaves pressures of points in a cell apart: set fBar = True, or pressureRelaxation = False.");
}

void requireSettings(const Analysis& engine)
{
	engine.requireAttributes();
	requireRelaxation(engine);
	requireGhost(engine);
	requireNonlocal(engine);
	requireEqualCells(engine);
	requireOneBody(engine);
	if (engine.newton->linearSolver == "amg") requireMultigrid();
	if (engine.maxSplits > 0 && engine.basis != "gimp")
		throw std::invalid_argument(
		        "maxSplits = " + std::to_string(engine.maxSplits) + " needs basis='gimp': with basis='" + engine.basis
		        + "' points have no domains on the grid that could outgrow a cell. Set maxSplits = 0.");
	const auto conditions = engine.conditions();
	requireOnce(conditions);
	engine.requireConditions();
	for (const Listed& listed : conditions)
		listed.condition->requireFitting(engine, listed.name());
}

void requireRunnable(const Analysis& engine)
{
	engine.requireAttributes();
	requireNoDecomposition(engine.sceneOfRun());
	requireOnlyClaim(engine);
	requireOnlyContact(engine);
	Scene&             scene = engine.sceneOfRun();
	std::ostringstream text;
	if (!(scene.dt > 0) || !std::isfinite(scene.dt))
		text << "O.dt = " << scene.dt
		     << " is not admitted: expected a finite number > 0, the load time of one step (with the default loadCurve, 1/80 gives 80 steps).";
	else if (engine.period() == 1 && scene.timeStepperActive())
		text << "an active TimeStepper among O.engines sets O.dt, which is the load increment of a step: remove it, set its active=False, or run this engine "
		        "every N iterations with iterPeriod=N.";
	else if (scene.isPeriodic)
		text << "a periodic scene (O.periodic) is not supported.";
	else if (scene.time + scene.dt <= engine.loadTime)
		text << "O.time + O.dt = " << scene.time + scene.dt << " is not after the last converged load time " << engine.loadTime
		     << ". After O.resetTime() set loadTime = O.time.";
	else
		return;
	throw std::invalid_argument(engine.className() + ": " + text.str());
}

void requireSeconds(const Analysis& engine, const vector<MaterialPoint>& points)
{
	const auto found = std::find_if(points.begin(), points.end(), [](const MaterialPoint& point) { return point.material->timeAttribute(); });
	if (found == points.end() || engine.isDynamic()) return;
	const auto conditions = engine.conditions();
	if (std::any_of(conditions.begin(), conditions.end(), [&](const Listed& listed) { return listed.condition->countsSeconds(engine.sceneOfRun()); }))
		return;
	const MpmMaterial& material = *found->material;
	throw std::invalid_argument(
	        engine.className() + ": Material '" + material.label + "' has a " + material.timeAttribute()
	        + ", by which it flows in seconds, but O.time is a load factor here. It counts seconds in an MpmDynamicEngine, with flow (MpmFlow), and where a wall or a "
	          "body that touches the soil moves by its velocity.");
}

void requireAny(const vector<MaterialPoint>& points, const Analysis& engine)
{
	if (!points.empty()) return;
	if (materialPoints(engine.sceneOfRun()).empty())
		throw std::invalid_argument(engine.className() + ": the scene has no material points; add them with O.bodies.append(mpm.fill(...)).");
	throw std::invalid_argument(
	        engine.className() + ": the scene has no material points whose groupMask goes with mask = " + std::to_string(engine.mask) + ".");
}

} // namespace yade
