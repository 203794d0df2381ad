// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/parallel/distribution.hpp"
#include "core/base/sentence.hpp"
#include "core/grid/neighbourhood.hpp"
#include "engine/analysis/MpmCondition.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/analysis/empty_model.hpp"
#include "engine/analysis/exchange.hpp"
#include "engine/grid/newPoints.hpp"
#include "engine/parallel/common_state.hpp"
#include "engine/parallel/packed_bodies.hpp"
#include "engine/parallel/pieces.hpp"
#include "engine/parallel/processes.hpp"
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

	// Erases bodies with all parts: YADE never lets go of bodies that O.bodies.append() was given in a list.
	void eraseFrom(Scene& scene, const vector<Body::id_t>& ids)
	{
		if (ids.empty()) return;
		const PythonLock python; // Python holds them, too
		for (const Body::id_t id : ids) {
			const shared_ptr<Body> body = (*scene.bodies)[id];
			scene.bodies->erase(id, false);
			body->state.reset();
			body->shape.reset();
		}
	}

	// Layers of bodies of points in contact (Model::layers), before there is a model.
	template <int Dim> vector<int> layersOf(const Analysis& engine)
	{
		return engine.bodiesMeet() ? emptyModel<Dim>(engine, conditionsOf<Dim>(engine)).layers : vector<int>();
	}

	// Lowest cell of a position, half of a domain, which reaches no farther than half a cell, and a body of points.
	template <int Dim> auto lowestCellIn(const Analysis& engine)
	{
		return [layers = layersOf<Dim>(engine), lattice = engine.grid->lattice<Dim>(),
		        basis
		        = engine.basis == "mpm" ? gimpm::Basis::linear : gimpm::Basis::gimp](const Vector3r& position, const Vector3r& halfSize, int body) {
			if (!layers.empty()) requireBody(body, int(layers.size()) - 1, "Points");
			const int layer = layers.empty() ? 0 : layers[body + 1];
			return gimpm::lowestCell<Dim>(position.head<Dim>(), halfSize.head<Dim>().cwiseMin(0.5 * lattice.cellSize), lattice, basis, layer);
		};
	}

	// Loads by cell, in the order of the points.
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

// Anew where the work is not balanced to ten per cent. Behind the own points are those that all know, each of which
// counts once.
void Distribution::cut(const std::shared_ptr<const gimpm::Processes>& all, const vector<gimpm::Key>& lowest, size_t own)
{
	constexpr Real        admitted = 0.1;
	const bool            isCut    = int(first.size()) == all->size() - 1;
	const gimpm::Division before { all, first };
	const auto            isOfOther = [&](gimpm::Key key) { return isCut ? !before.owns(key) : all->rank() > 0; };
	vector<gimpm::Key>    counted   = lowest;
	counted.erase(std::remove_if(counted.begin() + own, counted.end(), isOfOther), counted.end());
	const auto loads = loadsOf(std::move(counted));
	if (isCut && gimpm::imbalance(*all, loads) <= admitted) return;
	first = gimpm::cutByWork(gimpm::joined(*all, loads), all->size());
}

template <int Dim> std::shared_ptr<gimpm::Division> Distribution::divide(Analysis& engine, vector<MaterialPoint>& points, const vector<gimpm::Key>& added)
{
	const auto         all        = processes();
	Scene&             scene      = engine.sceneOfRun();
	const Pieces       before     = Pieces::of(scene);
	const size_t       own        = firstOfAll(points, before.bodies);
	const auto         lowestCell = lowestCellIn<Dim>(engine);
	vector<gimpm::Key> lowest;
	for (const MaterialPoint& p : points)
		lowest.push_back(lowestCell(p.state->pos, p.shape->halfSize, p.state->body));
	lowest.insert(lowest.end(), added.begin(), added.end());
	requireSame(*all, engine, points, own);
	cut(all, lowest, own);
	const auto                 division = std::make_shared<gimpm::Division>(gimpm::Division { all, first });
	vector<vector<Body::id_t>> leaving(all->size());
	vector<Body::id_t>         erased;
	for (size_t p = 0; p < points.size(); ++p) {
		if (division->owns(lowest[p])) continue;
		if (p < own) leaving[division->processOf(lowest[p])].push_back(points[p].id);
		erased.push_back(points[p].id);
	}
	vector<vector<double>> messages;
	for (const auto& ids : leaving)
		messages.push_back(packBodies(scene, ids));
	points.clear();
	eraseFrom(scene, erased);
	for (const auto& message : gimpm::exchanged(*all, messages))
		unpackBodies(message, scene);
	// Memory of erased bodies, and of the heap of the thread of the step before, is given back: a sixth of the
	// peak.
	malloc_trim(0);
	Pieces::note(scene, *all);
	updateMaterialPoints(points, scene, engine.mask);
	for (const MaterialPoint& p : points)
		division->id.push_back(p.id);
	return division;
}

template <int Dim> vector<int> Distribution::ownOf(Analysis& engine, vector<MaterialPoint>& points, const NewPoints& added)
{
	const auto all = processes();
	together(
	        [&] {
		        updateMaterialPoints(points, engine.sceneOfRun(), engine.mask);
		        requireWhole(engine);
		        requireDivisible(engine, points);
	        },
	        *all);
	requireSame(*all, added);
	const auto         lowestCell = lowestCellIn<Dim>(engine);
	vector<gimpm::Key> lowest;
	for (size_t i = 0; i < added.size(); ++i)
		lowest.push_back(lowestCell(added.position(i), added.halfSize(i), added.bodyOfPoints()));
	const auto  division = divide<Dim>(engine, points, lowest);
	vector<int> own;
	for (size_t i = 0; i < lowest.size(); ++i)
		if (division->owns(lowest[i])) own.push_back(int(i));
	return own;
}

#define MPM_INSTANTIATE(Dim)                                                                                                                                   \
	template std::shared_ptr<gimpm::Division> Distribution::divide<Dim>(Analysis&, vector<MaterialPoint>&, const vector<gimpm::Key>&);                     \
	template vector<int>                      Distribution::ownOf<Dim>(Analysis&, vector<MaterialPoint>&, const NewPoints&);
MPM_INSTANTIATE(2)
MPM_INSTANTIATE(3)
#undef MPM_INSTANTIATE

namespace {
	bool isAlone(const Analysis& engine)
	{
		const auto& engines = engine.sceneOfRun().engines;
		return std::none_of(engines.begin(), engines.end(), [&](const auto& other) {
			const auto* analysis = dynamic_cast<const Analysis*>(other.get());
			return analysis && analysis != &engine;
		});
	}
}

void Distribution::requireWhole(const Analysis& engine)
{
	const auto all   = processes();
	const int  count = all->size(), number = all->rank();
	const auto has = Pieces::of(engine.sceneOfRun());
	if (has.count == 0 || (has.count == count && has.number == number && engine.distributed)) return;
	throw std::invalid_argument(sentence(
	        engine.className(), ": the scene has the material points of process ", has.number, " of ", has.count, ", and this is process ", number, " of ",
	        count, engine.distributed ? "" : ", without distributed = True",
	        ". mpm.load(file) puts together what mpm.save has written in several processes, for any number of them."));
}

void Distribution::requireDivisible(const Analysis& engine, const vector<MaterialPoint>& points)
{
	const string start = engine.className() + ".distributed = True";
	if (!isAlone(engine))
		throw std::invalid_argument(
		        start + " does not go with a second engine with material points in O.engines; leave it out, and each process holds all points.");
	for (const MaterialPoint& point : points)
		if (point.materialIndex(engine.sceneOfRun()) < 0)
			throw std::invalid_argument(
			        sentence("Body #", point.id, ": ", start, " needs materials that are in O.materials, which its own is not."));
}

// A scene of one process may be a piece, too, which no step is made with.
std::shared_ptr<const gimpm::Processes> holdersOf(const Scene& scene) { return Pieces::of(scene).count > 1 ? processes() : gimpm::Processes::alone(); }

std::shared_ptr<const gimpm::Processes> holdersOf(const Analysis& engine) { return holdersOf(*engine.ownScene()); }

bool isDivided(const Analysis& engine) { return holdersOf(engine)->size() > 1; }

bool isSceneDivided() { return holdersOf(*Singleton<Omega>::instance().getScene())->size() > 1; }

void takePieces()
{
	const ValueLock lock;
	Pieces::note(*Singleton<Omega>::instance().getScene(), *processes());
}

} // namespace yade
