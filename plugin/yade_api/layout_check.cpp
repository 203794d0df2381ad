// SPDX-License-Identifier: GPL-2.0-or-later
#include "yade_api/layout_check.hpp"
#include "yade_api/grids.hpp"
#include "yade_api/scene.hpp"

namespace yade {

static void checkMembersOfBody(LayoutCheck& check)
{
	const auto body = check.make<Body>();
	check.require(*body, "material", body->material, check.make<Material>());
	check.require(*body, "state", body->state, check.make<State>());
	check.require(*body, "shape", body->shape, check.make<Shape>());
	check.require(!body->bound && body->intrs.empty(), "Body.bound, Body.intrs");

	const auto state = check.make<State>();
	check.require(*state, "vel", state->vel, Vector3r(1, 2, 3));
	check.require(*state, "angVel", state->angVel, Vector3r(4, 5, 6));
	check.require(*state, "angMom", state->angMom, Vector3r(7, 8, 9));
	check.require(*state, "inertia", state->inertia, Vector3r(1, 5, 9));
	check.require(*state, "refPos", state->refPos, Vector3r(3, 5, 7));
	check.require(state->refOri.w() == 1 && state->refOri.vec().isZero(0), "State.refOri");

	const auto shape = check.make<Shape>();
	check.require(*shape, "color", shape->color, Vector3r(.1, .2, .3));
	const auto box = check.make<Box>();
	check.require(*box, "extents", box->extents, Vector3r(2, 4, 8));
	const auto facet = check.make<Facet>();
	check.require(*facet, "vertices", facet->vertices, vector<Vector3r> { { 0, 0, 0 }, { 3, 0, 0 }, { 0, 4, 0 } });
}

static void checkMembersOfGrids(LayoutCheck& check)
{
	const auto node = check.make<Body>();
	const auto grid = check.make<GridConnection>();
	check.make<GridNode>();
	check.require(*grid, "node1", grid->node1, node);
	check.require(*grid, "node2", grid->node2, check.make<Body>());
	check.require(*grid, "periodic", grid->periodic, true);
	check.require(*grid, "cellDist", grid->cellDist, Vector3i(1, 2, 3));

	const auto facet = check.make<PFacet>();
	check.require(*facet, "node1", facet->node1, node);
	check.require(*facet, "node3", facet->node3, check.make<Body>());
	check.require(*facet, "conn1", facet->conn1, node);
	check.require(*facet, "conn3", facet->conn3, check.make<Body>());
	check.require(*facet, "radius", facet->radius, 0.0625);
	check.require(*facet, "cellDist", facet->cellDist, Vector3i(3, 2, 1));

	const auto cylinder = check.make<ChainedCylinder>();
	check.require(*static_cast<Cylinder*>(cylinder.get()), "length", cylinder->length, 0.75);
	const auto state = check.make<ChainedState>();
	check.require(*state, "rank", state->rank, 7u);
	check.require(*state, "chainNumber", state->chainNumber, 9u);
}

static void checkForces(LayoutCheck& check, ForceContainer& forces)
{
	const Vector3r force(1, 2, 3);
	forces.addForce(3, force);
	check.require(!forces.synced, "ForceContainer.synced before sync()");
	forces.sync();
	check.require(forces.synced && forces.lastReset == 0, "ForceContainer.synced after sync()");
	check.require(forces.getForce(3) == force, "ForceContainer.getForce()");
	forces.addTorque(3, force);
	forces.sync();
	check.require(forces.getTorque(3) == force, "ForceContainer.getTorque()");
}

static void checkMembersOfScene(LayoutCheck& check)
{
	const auto scene = check.make<Scene>();
#ifdef YADE_API_QT5
	check.require(!scene->renderer, "Scene.renderer");
#endif
	check.require(scene->tags.size() >= 3, "Scene.tags"); // author, creation date, identifier
	check.require(scene->engines.empty() && scene->_nextEngines.empty() && scene->materials.empty(), "Scene.engines, Scene.materials");
	check.require(scene->bodies && scene->interactions && scene->energy && scene->cell, "Scene.bodies ... Scene.cell");
	check.require(!scene->bound && scene->miscParams.empty() && scene->dispParams.empty(), "Scene.bound ... Scene.dispParams");
	check.require(!scene->timeStepperActive(), "Scene::timeStepperActive()");
	checkForces(check, scene->forces);
	if (!scene->bodies) return;

	const auto       body = check.make<Body>();
	const Body::id_t id   = scene->bodies->insert(body);
	check.require(id == 0 && scene->bodies->size() == 1 && (*scene->bodies)[0] == body, "BodyContainer");
	check.require(scene->bodies->exists(0) && !scene->bodies->exists(1), "BodyContainer::exists()");

	const auto bodies = check.make<BodyContainer>();
	check.require(*bodies, "useRedirection", bodies->useRedirection, true);
	check.require(*bodies, "enableRedirection", bodies->enableRedirection, false);
	const bool isFree = bodies->drawloopmutex.try_lock();
	check.require(isFree, "BodyContainer.drawloopmutex");
	if (isFree) bodies->drawloopmutex.unlock();
}

static void checkThreadRunner(LayoutCheck& check)
{
	Omega& omega = Singleton<Omega>::instance();
	if (!omega.simulationLoop || omega.isRunning()) return;
	const ThreadRunner& runner = *omega.simulationLoop;
	const size_t        size   = malloc_usable_size(omega.simulationLoop.get());
	// ThreadRunner is one piece of memory.
	check.require(sizeof(ThreadRunner) <= size && size < sizeof(ThreadRunner) + 32, "size of ThreadRunner");
	check.require(!runner.looping && !runner.workerThrew, "ThreadRunner.workerThrew");
}

vector<string> findLayoutErrors()
{
	LayoutCheck check([](const string& className) { return Singleton<ClassFactory>::instance().createShared(className); });
	check.checkSizesAndScalars();
	checkMembersOfBody(check);
	checkMembersOfGrids(check);
	checkMembersOfScene(check);
	checkThreadRunner(check);
	return check.errors();
}

} // namespace yade
