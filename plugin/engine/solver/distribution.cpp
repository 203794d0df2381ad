// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/distribution.hpp"
#include "core/base/sentence.hpp"
#include "engine/points/bodyParcels.hpp"
#include "engine/solver/MpmImplicitEngine.hpp"
#include "engine/solver/divided_scene.hpp"
#include "engine/solver/processes.hpp"
#include "engine/solver/sameness.hpp"
#include "yade_api/python_lock.hpp"
#include "yade_api/value_lock.hpp"
#include <malloc.h>

namespace yade {

namespace {
	using gimpm::sentence;

	// The first point that all processes have, as it has been added since the last division.
	size_t firstOfAll(const vector<MaterialPoint>& points, int bodiesInPieces)
	{
		return std::partition_point(points.begin(), points.end(), [&](const MaterialPoint& p) { return p.id < bodiesInPieces; }) - points.begin();
	}

	// Another engine goes on with its points.
	void adopt(MpmImplicitEngine& engine)
	{
		if (engine.Pieces::count == 0 && DividedScene::last().is(engine.scene)) static_cast<Pieces&>(engine) = DividedScene::last().pieces;
	}

	// With what they consist of: YADE never lets go of bodies that O.bodies.append() was given in a list.
	void eraseFrom(Scene& scene, const vector<Body::id_t>& ids)
	{
		if (ids.empty()) return;
		const PythonLock python; // which holds them, too
		for (const Body::id_t id : ids) {
			const shared_ptr<Body> body = (*scene.bodies)[id];
			scene.bodies->erase(id, false);
			body->state.reset();
			body->shape.reset();
		}
	}

	// By cell, in the order of the points.
	vector<gimpm::CellLoad> loadsOf(vector<gimpm::Key> lowest)
	{
		std::sort(lowest.begin(), lowest.end());
		vector<gimpm::CellLoad> loads;
		for (const gimpm::Key key : lowest)
			if (!loads.empty() && loads.back().lowest == key) ++loads.back().points;
			else
				loads.push_back({ key, 1 });
		return loads;
	}
}

template <int Dim> vector<gimpm::Key> Distribution::lowestCells(const MpmImplicitEngine& engine, const vector<MaterialPoint>& points) const
{
	const auto         lattice = engine.grid->lattice<Dim>();
	const auto         basis   = engine.basis == "mpm" ? gimpm::Basis::linear : gimpm::Basis::gimp;
	vector<gimpm::Key> lowest;
	for (const MaterialPoint& p : points) {
		const gimpm::Vec<Dim> half = p.shape->halfSize.head<Dim>().cwiseMin(0.5 * lattice.cellSize);
		lowest.push_back(gimpm::lowestCell<Dim>(p.state->pos.head<Dim>(), half, lattice, basis));
	}
	return lowest;
}

// Anew where the work is not balanced to ten per cent. Points of all processes are counted by the first one.
void Distribution::cut(const gimpm::Processes& all, const vector<gimpm::Key>& lowest, size_t own)
{
	constexpr Real admitted = 0.1;
	const size_t   counted  = all.rank() == 0 ? lowest.size() : own;
	const auto     loads    = loadsOf({ lowest.begin(), lowest.begin() + counted });
	const bool     isCut    = int(first.size()) == all.size() - 1;
	if (isCut && gimpm::imbalance(all, loads) <= admitted) return;
	first = gimpm::cutByWork(gimpm::joined(all, loads), all.size());
}

template <int Dim> std::shared_ptr<gimpm::Division> Distribution::divide(MpmImplicitEngine& engine, vector<MaterialPoint>& points)
{
	const auto all   = processes();
	Scene&     scene = *engine.scene;
	adopt(engine);
	const size_t own    = firstOfAll(points, engine.Pieces::bodies);
	const auto   lowest = lowestCells<Dim>(engine, points);
	requireSame(*all, engine, points, own);
	cut(*all, lowest, own);
	const auto                 division = std::make_shared<gimpm::Division>(gimpm::Division { all, first });
	vector<vector<Body::id_t>> leaving(all->size());
	vector<Body::id_t>         erased;
	for (size_t p = 0; p < points.size(); ++p) {
		if (division->owns(lowest[p])) continue;
		if (p < own) leaving[division->holderOf(lowest[p])].push_back(points[p].id);
		erased.push_back(points[p].id);
	}
	vector<vector<double>> parcels;
	for (const auto& ids : leaving)
		parcels.push_back(packBodies(scene, ids));
	const bool isFirst = engine.Pieces::count == 0;
	points.clear();
	eraseFrom(scene, erased);
	for (const auto& parcel : gimpm::exchanged(*all, parcels))
		unpackBodies(parcel, scene);
	if (isFirst) malloc_trim(0); // most of what there was is free now
	engine.Pieces::count = all->size(), engine.Pieces::number = all->rank(), engine.Pieces::bodies = int(scene.bodies->size());
	DividedScene::last() = { scene, engine };
	updateMaterialPoints(points, scene, engine.mask);
	for (const MaterialPoint& p : points)
		division->id.push_back(p.id);
	return division;
}

template std::shared_ptr<gimpm::Division> Distribution::divide<2>(MpmImplicitEngine&, vector<MaterialPoint>&);
template std::shared_ptr<gimpm::Division> Distribution::divide<3>(MpmImplicitEngine&, vector<MaterialPoint>&);

namespace {
	// With a name and its value, if the engine has it.
	string whatIsRefused(const MpmImplicitEngine& engine)
	{
		if (!engine.contacts.empty()) return "contacts";
		if (!engine.loads.empty()) return "loads";
		if (!engine.water.empty()) return "water";
		if (!engine.grid->period.isZero(0)) return sentence("MpmGrid.period = (", engine.grid->period.transpose(), ")");
		if (engine.grid->axisymmetric) return "MpmGrid.axisymmetric";
		for (size_t b = 0; b < engine.boundaries.size(); ++b)
			if (engine.boundaries[b]->surface) return sentence("boundaries[", b, "].surface");
		for (const auto& other : engine.scene->engines)
			if (other.get() != &engine && dynamic_cast<const MpmImplicitEngine*>(other.get()))
				return "a second engine with material points in O.engines";
		return "";
	}

	string whatIsRefused(const MaterialPoint& point, const Scene& scene)
	{
		if (point.materialIndex(scene) < 0) return "a material that is not in O.materials";
		if (!point.state->parameters.empty()) return "a strength or modulus of its own (" + point.state->parameters.front().first + ")";
		return "";
	}
}

void Distribution::requireWhole(const MpmImplicitEngine& engine)
{
	const auto  all   = processes();
	const int   count = all ? all->size() : 1, number = all ? all->rank() : 0;
	const auto& has = engine.Pieces::count == 0 && DividedScene::last().is(engine.scene) ? DividedScene::last().pieces : static_cast<const Pieces&>(engine);
	if (has.count == 0 || (has.count == count && has.number == number && engine.distributed)) return;
	throw std::invalid_argument(sentence(
	        engine.getClassName(), ": the scene has the material points of process ", has.number, " of ", has.count, ", and this is process ", number,
	        " of ", count, engine.distributed ? "" : ", without distributed = True",
	        ". mpm.load(file) puts together what mpm.save has written in several processes, for any number of them."));
}

void Distribution::requireDivisible(const MpmImplicitEngine& engine, const vector<MaterialPoint>& points)
{
	const string start = engine.getClassName() + ".distributed = True";
	if (const string what = whatIsRefused(engine); !what.empty())
		throw std::invalid_argument(sentence(start, " does not go with ", what, " yet; leave it out, and each process holds all points."));
	for (const MaterialPoint& point : points)
		if (const string what = whatIsRefused(point, *engine.scene); !what.empty())
			throw std::invalid_argument(sentence("Body #", point.id, ": ", start, " does not go with ", what, " yet."));
}

bool isDivided(const MpmImplicitEngine& engine) { return engine.Pieces::count > 1 || (engine.Pieces::count == 0 && DividedScene::last().is(engine.scene)); }

bool isSceneDivided()
{
	const auto scene = Singleton<Omega>::instance().getScene();
	for (const auto& engine : scene->engines)
		if (auto* found = dynamic_cast<MpmImplicitEngine*>(engine.get()); found && isDivided(*found)) {
			adopt(*found); // so that files know of it
			return true;
		}
	return DividedScene::last().is(scene.get());
}

void takePieces(int count, int number)
{
	const ValueLock lock;
	Scene&          scene = *Singleton<Omega>::instance().getScene();
	for (const auto& engine : scene.engines)
		if (auto* found = dynamic_cast<MpmImplicitEngine*>(engine.get()); found && isDivided(*found)) {
			found->Pieces::count  = count > 1 ? count : 0;
			found->Pieces::number = number;
			found->Pieces::bodies = count > 1 ? int(scene.bodies->size()) : 0;
			if (count > 1) DividedScene::last() = { scene, *found };
		}
}

} // namespace yade
