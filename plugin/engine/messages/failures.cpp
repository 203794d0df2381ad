// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/messages/failures.hpp"
#include "core/parallel/together.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/messages/idle.hpp"
#include "engine/parallel/distribution.hpp"
#include "engine/parallel/processes.hpp"
#include <iomanip>

namespace yade {

namespace {
	string placeOf(const MaterialPoint& point)
	{
		std::ostringstream text;
		text << " (body #" << point.id << " at " << point.state->pos.transpose() << ")";
		return text.str();
	}

	// Wherever it is. Of points that are divided among processes the report has the id.
	string placeOfFailed(int point, const Analysis& engine, const vector<MaterialPoint>& points)
	{
		if (point < 0) return "";
		if (!isDivided(engine)) return placeOf(points[point]);
		const auto found = std::find_if(points.begin(), points.end(), [&](const MaterialPoint& p) { return p.id == point; });
		return gimpm::firstSaid(*processes(), found == points.end() ? "" : placeOf(*found));
	}

	string bodiesNear(const Vector3r& place, const Analysis& engine, const vector<MaterialPoint>& points)
	{
		constexpr int      listed = 5;
		int                found  = 0;
		std::ostringstream text;
		for (const MaterialPoint& point : points)
			if ((point.state->pos - place).head(engine.grid->dim).cwiseAbs().maxCoeff() < engine.grid->cellSize && ++found <= listed)
				text << (found == 1 ? ", near it bodies #" : ", #") << point.id;
		if (found > listed) text << " and " << found - listed << " more";
		return gimpm::firstSaid(*holdersOf(engine), text.str());
	}

	string placeOfImbalance(const gimpm::StepReport& report, const Analysis& engine, const vector<MaterialPoint>& points)
	{
		if (report.residuals.empty() || report.worst.axis < 0) return "";
		const int          dim = engine.grid->dim;
		std::ostringstream text;
		text << " Residuals:";
		for (const Real r : report.residuals)
			text << " " << r;
		text << "; largest out-of-balance force " << report.worst.force << " N along "
		     << "xyz"[report.worst.axis] << " at node (" << report.worst.position.head(dim).transpose() << ")";
		text << bodiesNear(report.worst.position, engine, points) << ".";
		return text.str();
	}

	// Sentence if displacements have begun to run away from loads that grow, or nothing.
	string nearnessOfLimit(const Analysis& engine, const vector<MaterialPoint>& points)
	{
		constexpr Real fast      = 3;
		Real           largest[] = { 0, 0 }; // largest displacement of the last increment and of all
		for (size_t i = 0; i < engine.lastDisplacements.size(); i += 6)
			largest[0] = std::max(largest[0], Eigen::Map<const Vector3r>(&engine.lastDisplacements[i + 3]).norm());
		for (const MaterialPoint& point : points)
			largest[1] = std::max(largest[1], (point.state->pos - point.state->refPos).norm());
		const auto ofAll = gimpm::ofEach(*holdersOf(engine), largest, 2);
		for (size_t i = 0; i < ofAll.size(); ++i)
			largest[i % 2] = std::max(largest[i % 2], ofAll[i]);
		const Real growth = engine.lastLoadIncrement / engine.loadFactor;
		if (!(growth > 0 && largest[1] > 0 && largest[0] > fast * growth * largest[1])) return "";
		std::ostringstream text;
		text << std::setprecision(3) << " In the last step that converged, to load factor " << engine.loadFactor
		     << ", displacements grew with the load " << largest[0] / (growth * largest[1])
		     << " times as fast as on average until then, as they do near a limit load.";
		return text.str();
	}

	// Steps that are shorter may find what longer ones did not; of loads that grow the rest may be too much.
	string adviceOnConvergence(const Analysis& engine, const vector<MaterialPoint>& points, Real time, Real part)
	{
		const bool grows = engine.curveOfLoads().valueAt(time) != engine.loadFactor;
		if (part == 1) return " Smaller steps (O.dt), or newton.minStep < 1, may help.";
		if (engine.isDynamic())
			return " Smaller steps (O.dt) or a smaller newton.minStep may help; where the motion is right until then, what strikes, pushes or pulls so hard is "
			       "near the point that is named.";
		if (grows) return " The load may be more than the body can carry in equilibrium." + nearnessOfLimit(engine, points);
		return " What has changed since the step before (soil, water, strength, boundaries or bodies that move) may be more than the body can carry in equilibrium.";
	}

	string adviceOn(const gimpm::StepReport& report, const Analysis& engine, const vector<MaterialPoint>& points, Real time, Real part)
	{
		using gimpm::Failure;
		string advice;
		if (report.failure == Failure::unrestrained)
			return " Hold nodes of that material with MpmBoundary, or let it rest on a rigid body (MpmContact).";
		if (report.failure == Failure::misplaced) return "";
		if (!report.advice.empty()) return " " + report.advice;
		if (report.failure == Failure::gainsEnergy)
			return " Smaller steps (O.dt), a smaller newton.minStep or scheme='midpoint' would follow the motion.";
		if (report.failure == Failure::inaccurate)
			return " Smaller steps (O.dt), a smaller newton.minStep or a larger timeTolerance would let it pass.";
		if (report.failure == Failure::slides)
			return " It may have no equilibrium; more friction, or constrained nodes (MpmBoundary), would support it.";
		if (engine.isExplicit()) return " Explicit steps are not cut: a smaller O.dt may help, or an implicit scheme.";
		if (report.failure == Failure::interrupted) return " O.run() goes on from there.";
		if (report.failure == Failure::apart)
			return " The script must do the same in all of them, with one thread each where grains move (YADE's sums depend on the threads), and the "
			       "machines must be of one kind.";
		if (report.failure == Failure::stalled) return " Set newton.tolerance to that or more.";
		if (report.failure == Failure::detached)
			return " Nodes stay where they are while the soil moves, and push it by half a cell: put the box where the soil is now, in each step if it is pushed further, push it with a rigid body (MpmContact), or "
			       "move a block of stiff material points by nodes inside of it (examples/README.md, recipes).";
		if (engine.ghost->factor == 0)
			advice += " The ghost stabilisation is off (factor=0): small overlaps of material and cells make the system ill conditioned.";
		advice += adviceOnConvergence(engine, points, time, part);
		if (report.clampedDomains > 0) advice += " " + std::to_string(report.clampedDomains) + " domains had outgrown half a cell.";
		return advice;
	}

	// Stage that began between two steps and goes on in this one.
	string stageOf(const Analysis& engine)
	{
		for (const auto& other : engine.sceneOfRun().engines)
			if (!other->dead && other->label.rfind("stage_", 0) == 0) return " in " + other->label + " of mpm.stages";
		return "";
	}

	// Loads that grow tell where a static step is; otherwise it is the time.
	string stepOf(const Analysis& engine, Real time)
	{
		const gimpm::LoadCurve curve = engine.curveOfLoads();
		const Real             from = curve.valueAt(engine.loadTime), to = curve.valueAt(time);
		std::ostringstream     text;
		if (!engine.isDynamic() && from != to) text << "the load step from factor " << engine.loadFactor << " to " << to;
		else
			text << (engine.isDynamic() ? "the time step" : "the load step") << " from O.time = " << engine.loadTime << " to " << time << " s";
		text << stageOf(engine);
		if (engine.isDynamic() && from != to) text << ", of loads from factor " << from << " to " << to;
		return text.str();
	}

	string whereSceneIs(const Analysis& engine)
	{
		std::ostringstream text;
		if (engine.isDynamic()) text << " The scene is at " << engine.loadTime << " s";
		else
			text << " The scene is at load factor " << engine.loadFactor << ", O.time = " << engine.loadTime;
		text << ", the last converged state, in iteration " << engine.sceneOfRun().iter << ".";
		return text.str();
	}
}

const char* nameOf(gimpm::Failure failure)
{
	using gimpm::Failure;
	switch (failure) {
		case Failure::none: return "none";
		case Failure::detached: return "detached";
		case Failure::misplaced: return "misplaced";
		case Failure::unrestrained: return "unrestrained";
		case Failure::slides: return "slides";
		case Failure::penetrated: return "penetrated";
		case Failure::refused: return "refused";
		case Failure::inaccurate: return "inaccurate";
		case Failure::gainsEnergy: return "gainsEnergy";
		case Failure::stabilised: return "stabilised";
		case Failure::singular: return "singular";
		case Failure::inverted: return "inverted";
		case Failure::noResponse: return "noResponse";
		case Failure::notFinite: return "notFinite";
		case Failure::diverging: return "diverging";
		case Failure::tooManyIterations: return "tooManyIterations";
		case Failure::stalled: return "stalled";
		case Failure::apart: return "apart";
		case Failure::interrupted: return "interrupted";
	}
	return "";
}

const char* nameOf(gimpm::Definiteness definiteness)
{
	using gimpm::Definiteness;
	switch (definiteness) {
		case Definiteness::notChecked: return "not checked";
		case Definiteness::positive: return "positive definite";
		case Definiteness::indefinite: return "indefinite";
	}
	return "";
}

string reasonOf(const gimpm::StepReport& report, const Analysis& engine, const vector<MaterialPoint>& points, Real time, Real part)
{
	std::ostringstream text;
	text << engine.className() << ": " << stepOf(engine, time);
	if (!engine.gravityCurve.empty()) {
		const gimpm::LoadCurve curve = engine.curveOfGravity();
		const Real             from = curve.valueAt(engine.loadTime), to = curve.valueAt(time);
		if (from != to) text << ", of gravity from " << from << " to " << to;
	}
	if (part < 1) text << " (" << part << " of O.dt, after " << engine.cuts << " cuts)";
	text << " failed: " << report.cause;
	text << placeOfFailed(report.failedPoint, engine, points) << "." << placeOfImbalance(report, engine, points)
	     << adviceOn(report, engine, points, time, part);
	if (report.failure == gimpm::Failure::unrestrained)
		text << (engine.countOf("boundaries") == 0 ? " The engine has no boundaries." : "")
		     << idleConditions(engine, points, [](const auto&) { return true; });
	return text.str() + whereSceneIs(engine);
}

string warningOfAccepted(const gimpm::StepReport& report, const Analysis& engine, Real time)
{
	return stepOf(engine, time) + " has not converged and is accepted (newton.acceptUnconverged): " + report.cause + ".";
}

string warningOfShare(const Analysis& engine)
{
	constexpr Real much = 0.05;
	if (!(engine.ghostShare > much)) return "";
	std::ostringstream text;
	text << "in the step to O.time = " << engine.loadTime << ", load factor " << engine.loadFactor << ", the ghost stabilisation took up "
	     << std::lround(100 * engine.ghostShare)
	     << " % of the work at the edge of the body (ghostShare), which no stress in the points bears. Where soil flows there, loads may come out too high, by nothing to twice "
	        "that, and what stands may not stand: repeat with twice as many steps, or, in one process and without MpmFlow, with ghost=MpmGhost(where='aggregates', memory=1, workTolerance=0.03), "
	        "which goes on until stress bears the load. This is said once; plotData() tells of later steps.";
	return text.str();
}

string warningOfLoosePoints(const Analysis& engine)
{
	const auto& report = engine.last;
	if (report.loosePoints == 0) return "";
	std::ostringstream text;
	text << "in the step to O.time = " << engine.loadTime << " nothing restrains points apart from the rest, or connected to it by a corner of a cell ("
	     << report.loosePoints << ", the first around " << report.loosePosition
	     << "): no equilibrium tells where they go, so they are constrained where they are (report()['loosePoints'], by report()['looseForce']).";
	return text.str();
}

string warningOfNoUnknowns(const Analysis& engine)
{
	const auto all     = engine.conditions();
	const auto isActed = [](const Listed& listed) { return listed.condition->moves() || string(listed.list) == "flow"; };
	if (engine.isExplicit() || engine.dofs > 0 || std::any_of(all.begin(), all.end(), isActed)) return "";
	return "all nodes that material points touch are constrained in all directions, and none of them is moved, so that no point can move. An MpmBoundary without min "
	       "and max constrains the whole grid; max=(inf, 0, inf) constrains the nodes at y <= 0.";
}

} // namespace yade
