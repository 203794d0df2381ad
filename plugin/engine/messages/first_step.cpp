// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/messages/first_step.hpp"
#include "core/base/sentence.hpp"
#include "core/stepping/critical_step.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/materials/MpmElasticMat.hpp"
#include "yade_api/bodies.hpp"

namespace yade {

namespace {
	using gimpm::sentence;

	bool isMovedByBoundaries(const Analysis& engine)
	{
		const auto all = engine.conditions();
		return std::any_of(all.begin(), all.end(), [](const Listed& listed) { return listed.condition->moves(); });
	}

	template <int Dim> string warningOfNoLoad(const Analysis& engine, const vector<MaterialPoint>& points, const gimpm::PointCloud<Dim>& cloud)
	{
		const bool isMoving = engine.isDynamic() && std::any_of(points.begin(), points.end(), [](const auto& p) { return !p.state->vel.isZero(0); });
		const bool isAtRest = std::all_of(points.begin(), points.end(), [](const auto& p) { return p.isUnmoved(); })
		        && std::all_of(cloud.stress.begin(), cloud.stress.end(), [](const auto& stress) { return stress.c.isZero(0); });
		if (!engine.gravity.isZero(0) || !cloud.force.empty() || isMoving || !isAtRest || engine.conditions().size() > engine.countOf("boundaries")
		    || isMovedByBoundaries(engine))
			return "";
		return "nothing acts on the material points: gravity is 0, no boundary moves, and there is neither a load nor an initial stress, so that nothing "
		       "will happen. Gravity is given as in gravity=(0, -9.81, 0), loads as in loads=[MpmTraction(...)].";
	}

	string nameOf(const MpmMaterial& material) { return material.label.empty() ? material.getClassName() : "material '" + material.label + "'"; }

	string warningOfDensity(const Analysis& engine, const vector<MaterialPoint>& points)
	{
		if (engine.gravity.isZero(0) && !engine.isDynamic()) return "";
		for (const MaterialPoint& p : points)
			if (p.material->hasDefaultDensity())
				return sentence(
				        "the density of ", nameOf(*p.material), " was not given, and is YADE's default, ", p.material->density,
				        " kg/m3. Give it, as in density=2000.");
		return "";
	}

	string warningOfVelocity(const Analysis& engine, const vector<MaterialPoint>& points)
	{
		if (engine.isDynamic() || !std::all_of(points.begin(), points.end(), [](const auto& p) { return p.isUnmoved(); })) return "";
		for (const MaterialPoint& p : points)
			if (!p.state->vel.isZero(0))
				return sentence(
				        "body #", p.id, ", a material point, has the velocity (", p.state->vel.transpose(), ") m/s, which ", engine.className(),
				        " does not use, as its steps have no inertia. MpmDynamicEngine begins with given velocities.");
		return "";
	}

	// Columns one or two cells wide are compressed along one axis, and do not lock.
	bool isWide(const gimpm::Grid<2>& grid, const Vector3r& extent) { return extent.head<2>().minCoeff() > 2.5 * grid.cellSize; }
	bool isWide(const gimpm::Grid<3>& grid, const Vector3r& extent) { return (extent.array() > 2.5 * grid.cellSize).count() >= 2; }

	template <int Dim>
	string warningOfLocking(const Analysis& engine, const vector<MaterialPoint>& points, const gimpm::Grid<Dim>& grid, const Vector3r& extent)
	{
		constexpr Real nearlyIncompressible = 0.48;
		if (engine.fBar || !isWide(grid, extent)) return "";
		for (const MaterialPoint& p : points) {
			const auto* elastic = dynamic_cast<const MpmElasticMat*>(p.material.get());
			if (!elastic || !(elastic->poisson >= nearlyIncompressible)) continue;
			return sentence(
			        "poisson = ", elastic->poisson, " of ", nameOf(*p.material),
			        " without fBar makes cells too stiff where the body bends or shears (locking).",
			        " fBar=True avoids it; a smaller ratio, up to 0.3, needs it less.");
		}
		return "";
	}

	// F-bar keeps the mean dilation of a cell alone; domains of the points' volume tie that of each point to it.
	string warningOfDrift(const Analysis& engine)
	{
		if (!engine.fBar || engine.basis != "mpm") return "";
		return sentence(
		        "basis = 'mpm' with fBar = True lets volumes of points in a cell drift apart where soil shears on and on. basis='gimp' keeps them equal; "
		        "fBar=False is for soil that does not lock.");
	}

	// YADE begins with O.dt = 1e-8, for grains, which may also need steps that are as short.
	template <int Dim> string warningOfShortStep(const Analysis& engine, const gimpm::PointCloud<Dim>& cloud, const gimpm::Model<Dim>& model)
	{
		constexpr Real ofYade = 1e-8, fewest = 1e-4; // [s]; cells
		const Real     dt = engine.ownScene()->dt;
		if (!engine.isDynamic() || engine.period() != 1 || (engine.countOf("contacts") > 0 && dt != ofYade)) return "";
		const Real wave = std::sqrt(gimpm::stiffestOfOwn(cloud, model).pressureWave), cells = dt * wave / model.grid.cellSize;
		if (!(cells < fewest)) return "";
		return sentence(
		        "O.dt = ", dt, " s", dt == ofYade ? ", YADE's default" : "", ", in which the fastest wave, of ", wave, " m/s, goes ", cells,
		        " cells: was O.dt forgotten? O.dt = ", model.grid.cellSize / (2 * wave), " is half a cell.");
	}

	// Bodies of YADE that have a shape and are within or beside the soil, but touch nothing of it.
	string warningOfNoContact(const Analysis& engine, const Vector3r& low, const Vector3r& high)
	{
		if (engine.countOf("contacts") > 0) return "";
		const Vector3r   reach = Vector3r::Constant(2 * engine.grid->cellSize);
		const auto       scene = engine.ownScene();
		const BodiesLock lock(*scene);
		for (size_t id = 0; id < scene->bodies->size(); ++id) {
			const auto& body = (*scene->bodies)[unsigned(id)];
			if (!body || !body->shape || dynamic_cast<const MpmPoint*>(body->shape.get())) continue;
			const Vector3r& x        = body->state->pos;
			const auto      isInside = ((x - low + reach).array() > 0 && (high + reach - x).array() > 0).head(engine.grid->dim);
			if (isInside.all())
				return sentence(
				        "body #", body->id, ", a ", body->shape->getClassName(), " at (", x.transpose(), "), is in the soil or beside it, and ",
				        engine.className(), " has no contacts, so that soil passes through it. contacts=[MpmContact(...)] makes them touch.");
		}
		return "";
	}
}

template <int Dim>
std::map<string, string> warningsOfFirstStep(
        const Analysis& engine, const vector<MaterialPoint>& points, const gimpm::PointCloud<Dim>& cloud, const gimpm::Model<Dim>& model)
{
	std::map<string, string> found;
	if (!model.division->isWhole() || points.empty()) return found;
	Vector3r low = points.front().state->pos, high = low;
	for (const MaterialPoint& p : points) {
		low  = low.cwiseMin(p.state->pos - p.shape->halfSize);
		high = high.cwiseMax(p.state->pos + p.shape->halfSize);
	}
	found["noLoad"]    = warningOfNoLoad(engine, points, cloud);
	found["density"]   = warningOfDensity(engine, points);
	found["velocity"]  = warningOfVelocity(engine, points);
	found["locking"]   = warningOfLocking(engine, points, model.grid, high - low);
	found["drift"]     = warningOfDrift(engine);
	found["shortStep"] = warningOfShortStep(engine, cloud, model);
	found["noContact"] = warningOfNoContact(engine, low, high);
	for (const Listed& listed : engine.conditions())
		if (found["firstDoubt"].empty()) found["firstDoubt"] = listed.condition->firstDoubt(listed.name());
	return found;
}

template std::map<string, string> warningsOfFirstStep(const Analysis&, const vector<MaterialPoint>&, const gimpm::PointCloud<2>&, const gimpm::Model<2>&);
template std::map<string, string> warningsOfFirstStep(const Analysis&, const vector<MaterialPoint>&, const gimpm::PointCloud<3>&, const gimpm::Model<3>&);

} // namespace yade
