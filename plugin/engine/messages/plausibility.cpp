// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/messages/plausibility.hpp"
#include "core/base/checksum.hpp"
#include "core/base/sentence.hpp"
#include "core/base/stopwatch.hpp"
#include "core/stepping/critical_step.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/grid/lattice.hpp"
#include "engine/grid/overlaps.hpp"
#include "engine/messages/first_step.hpp"
#include "engine/messages/idle.hpp"
#include "engine/messages/units.hpp"
#include "engine/parallel/distribution.hpp"

namespace yade {

namespace {
	using gimpm::sentence;

	template <class... Parts> [[noreturn]] void refuse(const Parts&... parts) { throw std::invalid_argument(sentence(parts...)); }

	void requireGravityInPlane(const Analysis& engine)
	{
		if (engine.grid->axisymmetric && engine.gravity[0] != 0)
			refuse(engine.className(), ".gravity = (", engine.gravity.transpose(),
			       ") has an x component, which with MpmGrid.axisymmetric would pull away from the axis on all sides; there gravity acts along the axis, y, "
			       "as in (0, -9.81, 0).");
		if (engine.grid->dim == 3 || engine.gravity[2] == 0) return;
		refuse(engine.className(), ".gravity = (", engine.gravity.transpose(),
		       ") has a z component, which a grid with dim=2 (plane strain in x-y) would leave out; ",
		       "there gravity acts along y, as in (0, -9.81, 0).");
	}

	// YADE begins with O.dt = 1e-8, for grains.
	void requireSensibleIncrement(const Analysis& engine)
	{
		constexpr Real mostSteps = 1e6;
		const auto&    curve     = engine.loadCurve;
		const Real dt = engine.sceneOfRun().dt, left = engine.loadsEnd() - engine.sceneOfRun().time, length = engine.loadsEnd() - curve.front().first;
		if (engine.period() != 1 || left <= 0) return;
		if (left / dt > mostSteps)
			refuse(engine.className(), ": with O.dt = ", dt, " the load curve would take ", left / dt,
			       " steps; was O.dt forgotten? It is the load time of one step: 1/80 gives 80 steps with the default loadCurve.");
		const bool isInTime = engine.countOf("flow") > 0; // a load may be put on at once, and wait
		if (curve.size() > 1 && dt > length * (1 + 1e-9) && !isInTime)
			refuse(engine.className(), ": O.dt = ", dt, ", the load time of one step, is more than the whole loadCurve, from ", curve.front().first,
			       " to ", engine.loadsEnd(), ": 1/80 of that gives 80 steps.");
	}

	// Checksum of all that a check of the points depends on: a change of the deformation changes the sizes, too,
	// and the initial stress of points is that of their first check.
	template <int Dim> uint64_t fingerprint(const gimpm::PointCloud<Dim>& cloud)
	{
		gimpm::Checksum sum;
		sum.mix(cloud.position);
		sum.mix(cloud.halfSize);
		return sum.take();
	}

	string bothOf(const Overlaps::Pair& pair, const vector<MaterialPoint>& points)
	{
		const MaterialPoint &p = points[pair[0]], &q = points[pair[1]];
		return sentence(
		        "#", p.id, " and #", q.id, " are material points in the same place, at (", p.state->pos.transpose(), ") and (",
		        q.state->pos.transpose(), ")");
	}

	// Shear makes neighbours overlap here and there; what has been filled or loaded twice does so as a whole.
	string warningOfOverlap(const Overlaps& overlaps, const vector<MaterialPoint>& points)
	{
		// Limit as a part of all volume; in a vertical cut that has run out to half its height it was 0.006.
		constexpr Real byShear = 0.05;
		Real           all     = 0;
		for (const MaterialPoint& p : points)
			all += p.state->volume;
		if (overlaps.volume <= byShear * all) return "";
		return sentence(
		        "about ", overlaps.volume, " of ", all, " m3 of material are counted twice, where material points cover others: bodies ",
		        bothOf(overlaps.ofAny, points), ", for instance. Has a region been filled or a scene been loaded twice?");
	}

	// Mean over ground as it is before the first step: deformed points carry what equilibrium has given them.
	template <int Dim> Matrix3r meanInitialStress(const gimpm::PointCloud<Dim>& cloud)
	{
		Matrix3r sum    = Matrix3r::Zero();
		Real     volume = 0;
		for (size_t p = 0; p < cloud.size(); ++p) {
			if (cloud.defGrad[p] != gimpm::Mat<Dim>::Identity() || cloud.stress[p].c.isZero(0)) continue;
			volume += cloud.volume0[p];
			sum += cloud.volume0[p] * cloud.stress[p].full();
		}
		return volume > 0 ? Matrix3r(sum / volume) : sum;
	}

	string warningOfTension(const Vector3r& gravity, const Matrix3r& initialStress)
	{
		const Vector3r down    = gravity.normalized(); // zero without gravity
		const Real     tension = down.dot(initialStress * down);
		if (!(tension > 0)) return "";
		return sentence(
		        "the initial stress along gravity is tension, ", tension,
		        " Pa on average; stress is positive in tension: that of ground which carries its weight has a minus.");
	}

	string warningOfGravity(const Vector3r& gravity)
	{
		for (int axis = 0; axis < 3; ++axis)
			if (gravity[axis] > 0 && gravity[axis] == gravity.norm())
				return string("gravity acts along +") + "xyz"[axis] + ", upwards as most would draw it; downwards it has a minus.";
		return "";
	}

	string warningOfCells(Real cellSize, Real smallest)
	{
		constexpr Real most = 20; // points per cell and axis
		if (cellSize <= most * smallest) return "";
		return sentence(
		        "cellSize = ", cellSize, " m is more than ", most, " times the size of a material point (", smallest,
		        " m); is it the grid that mpm.fill was given?");
	}

	// From the bottom of a box to its top.
	Real alongGravity(const std::pair<Vector3r, Vector3r>& box, const Vector3r& gravity)
	{
		return gravity.isZero(0) ? 0 : gravity.normalized().cwiseAbs().dot(box.second - box.first);
	}

	// The first of each, by what it is about; of points that are divided no process has all.
	std::map<string, string> warningsOfConditions(const Analysis& engine, const vector<MaterialPoint>& points)
	{
		std::map<string, string>    found;
		const vector<MaterialPoint> none;
		for (const Listed& listed : engine.conditions())
			for (const auto& [about, warning] : listed.condition->warnings(engine, isDivided(engine) ? none : points, listed.name()))
				if (found[about].empty()) found[about] = warning;
		return found;
	}

	// Points that are as they were filled: in the first step all, later those of stages that are placed.
	vector<MaterialPoint> newOf(const vector<MaterialPoint>& points, bool areFirst)
	{
		vector<MaterialPoint> found;
		std::copy_if(points.begin(), points.end(), std::back_inserter(found), [&](const MaterialPoint& p) { return areFirst || p.isUnmoved(); });
		return found;
	}

	// Box of all points, as they were in the beginning.
	std::pair<Vector3r, Vector3r> initialBox(const vector<MaterialPoint>& points)
	{
		Vector3r lower = Vector3r::Constant(std::numeric_limits<Real>::infinity()), upper = -lower;
		for (const MaterialPoint& p : points) {
			lower = lower.cwiseMin(p.state->refPos - p.shape->halfSize0);
			upper = upper.cwiseMax(p.state->refPos + p.shape->halfSize0);
		}
		return { lower, upper };
	}
}

template <int Dim> bool Plausibility::isNew(const gimpm::PointCloud<Dim>& cloud) const { return known != fingerprint(cloud); }
template <int Dim> void Plausibility::know(const gimpm::PointCloud<Dim>& cloud) { known = fingerprint(cloud); }

namespace {
	// Columns of the cloud that are looked at.
	template <int Dim> gimpm::PointCloud<Dim> cloudOf(const vector<MaterialPoint>& points)
	{
		gimpm::PointCloud<Dim> cloud;
		for (const MaterialPoint& point : points) {
			cloud.position.push_back(point.state->pos.template head<Dim>());
			cloud.halfSize.push_back(point.shape->halfSize.template head<Dim>());
		}
		return cloud;
	}
}

template <int Dim> bool Plausibility::knows(const vector<MaterialPoint>& points) const { return !isNew(cloudOf<Dim>(points)); }
template <int Dim> void Plausibility::know(const vector<MaterialPoint>& points) { know(cloudOf<Dim>(points)); }

template <int Dim> void Plausibility::requirePoints(const vector<MaterialPoint>& points, const gimpm::PointCloud<Dim>& cloud)
{
	smallest = std::numeric_limits<Real>::infinity();
	largest  = 0;
	for (const auto& half : cloud.halfSize0) {
		smallest = std::min(smallest, 2 * half.minCoeff());
		largest  = std::max(largest, 2 * half.maxCoeff());
	}
	const Overlaps overlaps = findOverlaps(cloud);
	if (overlaps.ofFills != Overlaps::none)
		refuse("Bodies ", bothOf(overlaps.ofFills, points),
		       ": has a region been filled twice, or do two fills overlap? Give mpm.fill one region, with a list or function as material.");
	overlap       = warningOfOverlap(overlaps, points);
	initialStress = meanInitialStress(cloud);
	box           = initialBox(points);
	know(cloud);
}

string Plausibility::warningOfEnd(const Analysis& engine)
{
	const size_t knees  = engine.gravityCurve.size();
	const Real   end    = engine.loadsEnd();
	const auto   all    = engine.conditions();
	const auto   goesOn = [](const Listed& listed) { return listed.condition->goesOn(); };
	if (saidEnd || engine.isDynamic() || std::any_of(all.begin(), all.end(), goesOn) || std::max(engine.loadCurve.size(), knees) < 2
	    || engine.loadTime < end - 1e-9 * engine.sceneOfRun().dt)
		return "";
	saidEnd = true;
	return sentence(
	        knees < 2 ? "loadCurve has" : "loadCurve and gravityCurve have", " ended at time ", end, ": the load factor stays at ",
	        engine.loadCurve.back().second,
	        ". Unless something else changes, further steps move the points a little only, as each finds equilibrium on the grid that has been reset.");
}

string Plausibility::warningOfPlaces(const Analysis& engine, const vector<MaterialPoint>& points)
{
	std::set<const MpmCondition*> asked;
	decltype(lookedAt)            boxes;
	for (const Listed& listed : engine.conditions()) {
		const auto box = listed.condition->extent();
		if (!box) continue;
		boxes.push_back(*box);
		const bool isKnown = std::find(lookedAt.begin(), lookedAt.end(), *box) != lookedAt.end();
		if (!isKnown && !listed.condition->moves()) asked.insert(listed.condition.get());
	}
	lookedAt.swap(boxes);
	const auto   isAsked = [&](const MpmCondition& condition) { return asked.count(&condition) > 0; };
	const string idle    = asked.empty() ? "" : idleConditions(engine, points, isAsked);
	return idle.empty() ? "" : idle.substr(1) + " It constrains nothing until soil arrives there.";
}

string Plausibility::once(const string& about, const string& sentence) { return sentence.empty() || !saidAbout.insert(about).second ? "" : sentence; }

// No fill puts so many points into a cell that they are as small.
void Plausibility::requireGrid(const Analysis& engine) const
{
	constexpr Real most = 1e5; // points per cell and axis
	const Real     h    = engine.grid->cellSize;
	if (h / most > largest)
		refuse("MpmGrid.cellSize = ", h, " m is ", h / largest, " times the size of the largest material point (", largest,
		       " m), so that all of them would move as one cell does; is it the grid that mpm.fill was given, in the same unit?");
}

// Warning about implicit time steps, which are stable however long they are, but see nothing of what is over within
// one.
template <int Dim>
string Plausibility::warningOfLength(
        const Analysis& engine, const vector<MaterialPoint>& points, const gimpm::PointCloud<Dim>& cloud, const gimpm::Model<Dim>& model, bool areNew)
{
	constexpr Real mostOfWave = 100, mostOfPoint = 1; // cells a step
	const Real     T = engine.sceneOfRun().time + engine.sceneOfRun().dt - engine.loadTime;
	if (!engine.isDynamic() || engine.isExplicit() || (!areNew && std::abs(T - duration) <= 1e-3 * duration)) return length;
	if (areNew) fastestWave = std::sqrt(gimpm::stiffestOfOwn(cloud, model).pressureWave);
	duration     = T;
	Real fastest = 0;
	for (const MaterialPoint& point : points)
		fastest = std::max(fastest, (T * point.state->vel + T * T / 2 * engine.gravity).norm());
	const Real ofWave = T * fastestWave / model.grid.cellSize, ofPoint = fastest / model.grid.cellSize;
	length = ofWave <= mostOfWave && ofPoint <= mostOfPoint
	        ? ""
	        : sentence(
	                "a time step lasts ", T, " s (O.dt = ", engine.sceneOfRun().dt, "). In that time the fastest wave, of ", fastestWave, " m/s, goes ",
	                ofWave, " cells, and the fastest point would fly ", ofPoint,
	                " cells. For waves a step should be half a cell of theirs or less; what lasts longer is seen in steps of some cells, and "
	                "points should move less than half a cell.");
	return length;
}

void Plausibility::say(vector<string>& sentences, const string& about, const string& sentence)
{
	bool& isSaid = said[about];
	if (!sentence.empty() && !isSaid) sentences.push_back(sentence);
	isSaid = !sentence.empty();
}

template <int Dim> string Plausibility::warningOfPlaced(const vector<MaterialPoint>& points, const gimpm::Grid<Dim>& grid)
{
	vector<string> sentences;
	say(sentences, "lattice", warningOfLattice<Dim>(points, grid));
	return sentences.empty() ? "" : sentences.front();
}

template <int Dim>
vector<string> Plausibility::look(
        const Analysis& engine, const vector<MaterialPoint>& points, const gimpm::PointCloud<Dim>& cloud, const gimpm::Model<Dim>& model, double& time)
{
	requireGravityInPlane(engine);
	requireSensibleIncrement(engine);
	if (points.empty()) return {}; // other processes have them
	// Smaller cells have cut domains in the cloud.
	const bool areFirst = largest == 0, areNew = areFirst || (model.grid.refinement ? !knows<Dim>(points) : isNew(cloud));
	if (areNew) {
		const gimpm::Stopwatch watch(time);
		requirePoints(points, cloud);
	}
	requireGrid(engine);
	vector<string> sentences;
	say(sentences, "gravityUpwards", warningOfGravity(engine.gravity));
	say(sentences, "largeCells", warningOfCells(engine.grid->smallestCell(), smallest));
	say(sentences, "units", warningOfUnits(engine.gravity, alongGravity(box, engine.gravity), points, cloud.material, model.materials));
	if (areFirst)
		for (const auto& [about, warning] : warningsOfFirstStep(engine, points, cloud, model))
			say(sentences, about, warning);
	if (areNew) say(sentences, "lattice", warningOfLattice<Dim>(newOf(points, areFirst), model.grid));
	say(sentences, "tension", warningOfTension(engine.gravity, initialStress));
	say(sentences, "overlap", overlap);
	for (const auto& [about, warning] : warningsOfConditions(engine, points))
		say(sentences, about, warning);
	say(sentences, "longStep", warningOfLength(engine, points, cloud, model, areNew));
	return sentences;
}

template <int Dim>
vector<string> Plausibility::warningsOfResult(const Analysis& engine, const vector<MaterialPoint>& points, const gimpm::PointCloud<Dim>& cloud)
{
	vector<string> sentences;
	if (engine.isDynamic() || engine.gravity.isZero(0) || said["settlement"] || said["units"]) return sentences;
	const Vector3r down = engine.gravity.normalized(), sides = box.second - box.first;
	// Not the height: a slender beam may well bend by more than that.
	const Real size    = sides.head<Dim>().maxCoeff();
	const Real bottom  = (box.first + box.second + sides.cwiseProduct(down.cwiseSign())).dot(down) / 2;
	const auto isBelow = [&](const gimpm::Vec<Dim>& x) { return x.dot(down.head<Dim>()) > bottom; };
	// Then none has settled by more than the height.
	if (std::none_of(cloud.position.begin(), cloud.position.end(), isBelow)) return sentences;
	Real settlement = 0;
	for (const MaterialPoint& p : points)
		settlement = std::max(settlement, (p.state->pos - p.state->refPos).dot(down));
	if (settlement > size)
		say(sentences, "settlement",
		    sentence(
		            "the largest settlement, ", settlement, " m, is more than the size of the body, ", size,
		            " m; are the moduli in Pa, densities in kg/m3 and lengths in m?"));
	return sentences;
}

#define MPM_INSTANTIATE(Dim)                                                                                                                                   \
	template void           Plausibility::know(const gimpm::PointCloud<Dim>&);                                                                             \
	template string         Plausibility::warningOfPlaced<Dim>(const vector<MaterialPoint>&, const gimpm::Grid<Dim>&);                                     \
	template bool           Plausibility::knows<Dim>(const vector<MaterialPoint>&) const;                                                                  \
	template void           Plausibility::know<Dim>(const vector<MaterialPoint>&);                                                                         \
	template vector<string> Plausibility::warningsOfResult(const Analysis&, const vector<MaterialPoint>&, const gimpm::PointCloud<Dim>&);                  \
	template vector<string> Plausibility::look(                                                                                                            \
	        const Analysis&, const vector<MaterialPoint>&, const gimpm::PointCloud<Dim>&, const gimpm::Model<Dim>&, double&);
MPM_INSTANTIATE(2)
MPM_INSTANTIATE(3)
#undef MPM_INSTANTIATE

} // namespace yade
