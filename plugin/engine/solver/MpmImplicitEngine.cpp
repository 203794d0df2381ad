// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/MpmImplicitEngine.hpp"
#include "core/solvers/condition.hpp"
#include "core/stepping/load_step.hpp"
#include "core/base/stopwatch.hpp"
#include "core/stepping/workload.hpp"
#include "engine/solver/LoadStepObserver.hpp"
#include "engine/solver/exchange.hpp"
#include "engine/points/parallel.hpp"
#include "yade_api/exceptions.hpp"
#include "yade_api/interruption.hpp"
#include "yade_api/logging.hpp"
#include "yade_api/value_lock.hpp"
#include <atomic>
#include <omp.h>

namespace yade {

namespace {
	// Engine.ompThreads, if set, for the time of a step.
	class Threads {
	public:
		explicit Threads(int wanted)
		        : before(omp_get_max_threads())
		{
			requireThreadsOfThisProcess(wanted > 0 ? wanted : before);
			if (wanted > 0) omp_set_num_threads(wanted);
		}
		~Threads() { omp_set_num_threads(before); }

	private:
		int before;
	};

	std::atomic_int stepsAtWork { 0 };

	struct AtWork {
		AtWork() { ++stepsAtWork; }
		~AtWork() { --stepsAtWork; }
	};

	string placeOf(const MaterialPoint& point)
	{
		std::ostringstream text;
		text << " (body #" << point.id << " at " << point.state->pos.transpose() << ")";
		return text.str();
	}

	const char* nameOf(gimpm::Failure failure)
	{
		using gimpm::Failure;
		switch (failure) {
			case Failure::none: return "none";
			case Failure::detached: return "detached";
			case Failure::unrestrained: return "unrestrained";
			case Failure::singular: return "singular";
			case Failure::inverted: return "inverted";
			case Failure::noResponse: return "noResponse";
			case Failure::notFinite: return "notFinite";
			case Failure::diverging: return "diverging";
			case Failure::tooManyIterations: return "tooManyIterations";
			case Failure::stalled: return "stalled";
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

	bool canBeCut(gimpm::Failure failure)
	{
		using gimpm::Failure;
		return failure == Failure::singular || failure == Failure::inverted || failure == Failure::noResponse || failure == Failure::notFinite || failure == Failure::diverging
		        || failure == Failure::tooManyIterations;
	}

	// A scene that is saved carries the last increment along, so that it continues with the same bits: of each node the grid coordinates
	// and the displacement, three numbers each.
	template <int Dim> gimpm::LastIncrement<Dim> lastIncrement(const vector<Real>& flat, Real load)
	{
		const size_t              nodes = flat.size() / 6;
		gimpm::LastIncrement<Dim> last { vector<gimpm::Key>(nodes), Eigen::VectorXd(Dim * nodes), load };
		for (size_t n = 0; n < nodes; ++n) {
			gimpm::Index<Dim> place;
			for (int a = 0; a < Dim; ++a) {
				place[a]                       = int(flat[6 * n + a]);
				last.displacement[Dim * n + a] = flat[6 * n + 3 + a];
			}
			last.nodes[n] = gimpm::Grid<Dim>::key(place);
		}
		return last;
	}
	template <int Dim> vector<Real> flat(const gimpm::LastIncrement<Dim>& last)
	{
		vector<Real> numbers(6 * last.nodes.size(), 0);
		for (size_t n = 0; n < last.nodes.size(); ++n) {
			const auto place = gimpm::Grid<Dim>::index(last.nodes[n]);
			for (int a = 0; a < Dim; ++a) {
				numbers[6 * n + a]     = place[a];
				numbers[6 * n + 3 + a] = last.displacement[Dim * n + a];
			}
		}
		return numbers;
	}

	Real valueAt(const vector<std::pair<Real, Real>>& curve, Real time)
	{
		if (time <= curve.front().first) return curve.front().second;
		for (size_t i = 1; i < curve.size(); ++i) {
			const auto [t0, f0] = curve[i - 1];
			const auto [t1, f1] = curve[i];
			if (time <= t1) return f0 + (f1 - f0) * (time - t0) / (t1 - t0);
		}
		return curve.back().second;
	}

	template <class T> py::object numpyArray(const vector<T>& values, const char* type)
	{
		const char* bytes = reinterpret_cast<const char*>(values.data());
		py::object  copy { py::handle<>(PyByteArray_FromStringAndSize(bytes, values.size() * sizeof(T))) };
		return py::import("numpy").attr("frombuffer")(copy, type);
	}
}

MpmImplicitEngine::MpmImplicitEngine()
{
	iterPeriod   = 1;
	initRun      = true;
	timingDeltas = boost::make_shared<TimingDeltas>();
	if (scene) home = scene->weak_from_this(); // the current one
}

bool MpmImplicitEngine::isLoadCurve(const vector<std::pair<Real, Real>>& curve)
{
	for (size_t i = 0; i < curve.size(); ++i)
		if (!std::isfinite(curve[i].first) || !std::isfinite(curve[i].second) || (i > 0 && curve[i].first <= curve[i - 1].first)) return false;
	return !curve.empty();
}

bool MpmImplicitEngine::isIncrement(const vector<Real>& numbers)
{
	for (size_t i = 0; i < numbers.size(); ++i)
		if (!std::isfinite(numbers[i]) || (i % 6 < 3 && std::abs(numbers[i]) > gimpm::Grid<2>::indexLimit)) return false;
	return numbers.size() % 6 == 0;
}

bool MpmImplicitEngine::isStepAtWork() { return stepsAtWork > 0; }

bool MpmImplicitEngine::isActivated()
{
	beforeActivation = { virtLast, realLast, iterLast, nDone };
	if (PeriodicEngine::isActivated()) return true;
	const bool ends = isEndOfLoads();
	nDone += ends;
	return ends;
}

// An engine that does not run in every iteration would leave out the end of the load curve, where a run usually stops.
bool MpmImplicitEngine::isEndOfLoads() const
{
	const ValueLock lock;
	if (nDone == 0 || (nDo >= 0 && nDone >= nDo) || loadCurve.empty()) return false;
	const Real reached = loadsEnd() - 1e-9 * scene->dt;
	return loadTime < reached && scene->time + scene->dt >= reached;
}

shared_ptr<Scene> MpmImplicitEngine::ownScene()
{
	const auto& current = Singleton<Omega>::instance().getScene();
	const auto  holds   = [this](const Scene& s) { return std::any_of(s.engines.begin(), s.engines.end(), [this](const auto& e) { return e.get() == this; }); };
	if (holds(*current)) home = current;
	const auto other = boost::dynamic_pointer_cast<Scene>(home.lock());
	return other && holds(*other) ? other : current;
}

void MpmImplicitEngine::action()
{
	deliveringErrors([&] {
		home = scene->weak_from_this();
		if (omp_get_level() > 0)
			throw std::invalid_argument("MpmImplicitEngine: inside a ParallelEngine it cannot tell what other engines do with its material points; put it into O.engines itself.");
		if (PyGILState_Check() && Singleton<Omega>::instance().isRunning())
			throw std::runtime_error("MpmImplicitEngine: called while the scene runs in the background; call O.wait() or O.pause() first.");
		try {
			run();
		} catch (...) {
			virtLast = beforeActivation.virtLast;
			realLast = beforeActivation.realLast;
			iterLast = beforeActivation.iterLast;
			nDone    = beforeActivation.nDone;
			progressLine.end();
			if (!scene->subStepping) scene->subStep = -1; // YADE would count the iteration as begun, and finish it later
			tellObservers([this](LoadStepObserver& observer) { observer.stepEnds(*this, false); });
			throw;
		}
		tellObservers([this](LoadStepObserver& observer) { observer.stepEnds(*this, true); });
	});
}

template <class F> void MpmImplicitEngine::tellObservers(F tell) const
{
	for (const auto& engine : scene->engines)
		if (auto* observer = dynamic_cast<LoadStepObserver*>(engine.get()); observer && !engine->dead) {
			engine->scene = scene;
			tell(*observer);
		}
}

void MpmImplicitEngine::run()
{
	const Threads threads(ompThreads);
	if (grid && grid->dim == 3) step<3>();
	else
		step<2>();
}

void MpmImplicitEngine::requireRunnable() const
{
	requireAdmissible();
	requireOnlyClaim();
	std::ostringstream text;
	const bool everyIteration = iterPeriod == 1;
	if (!(scene->dt > 0) || !std::isfinite(scene->dt))
		text << "O.dt = " << scene->dt << " is not admitted: expected a finite number > 0, the load time of one step (with the default loadCurve, 1/80 gives 80 steps).";
	else if (everyIteration && scene->timeStepperActive())
		text << "an active TimeStepper among O.engines sets O.dt, which is the load increment of a step: remove it, set its active=False, or run this engine "
		        "every N iterations with iterPeriod=N.";
	else if (scene->isPeriodic)
		text << "a periodic scene (O.periodic) is not supported.";
	else if (scene->time + scene->dt <= loadTime)
		text << "O.time + O.dt = " << scene->time + scene->dt << " is not after the last converged load time " << loadTime
		     << ". After O.resetTime() set loadTime = O.time.";
	else
		return;
	throw std::invalid_argument("MpmImplicitEngine: " + text.str());
}

// Of several engines none may claim a point of another: it would be moved twice.
void MpmImplicitEngine::requireOnlyClaim() const
{
	vector<const MpmImplicitEngine*> others;
	int                              entries = 0;
	for (const auto& engine : scene->engines) {
		const auto* other = dynamic_cast<const MpmImplicitEngine*>(engine.get());
		if (other == this) ++entries;
		else if (other && !other->dead)
			others.push_back(other);
	}
	if (entries > 1) throw std::invalid_argument("MpmImplicitEngine: the same engine is listed " + std::to_string(entries) + " times in O.engines.");
	for (const auto* other : others)
		for (const MaterialPoint& point : materialPoints(*scene, mask))
			if (isMeant(*(*scene->bodies)[point.id], other->mask))
				throw std::invalid_argument(
				        "Body #" + std::to_string(point.id) + ": two MpmImplicitEngines in O.engines claim it, with mask = " + std::to_string(mask) + " and "
				        + std::to_string(other->mask) + "; give each body a groupMask that goes with one of them.");
}

string MpmImplicitEngine::noPoints() const
{
	const string hint = "; add them with O.bodies.append(mpm.fill(...)).";
	if (materialPoints(*scene).empty()) return "MpmImplicitEngine: the scene has no material points" + hint;
	return "MpmImplicitEngine: the scene has no material points whose groupMask goes with mask = " + std::to_string(mask) + ".";
}

Real MpmImplicitEngine::loadFactorAt(Real time) const { return valueAt(loadCurve, time); }
Real MpmImplicitEngine::gravityFactorAt(Real time) const { return valueAt(gravityCurve.empty() ? loadCurve : gravityCurve, time); }
Real MpmImplicitEngine::loadsEnd() const
{
	const Real loads = loadCurve.back().first;
	return gravityCurve.empty() ? loads : std::max(loads, gravityCurve.back().first);
}

template <int Dim> gimpm::Load<Dim> MpmImplicitEngine::loadAt(Real time) const
{
	gimpm::Load<Dim> load { gravity.head<Dim>(), loadFactorAt(time), loadFactorAt(time) - loadFactorAt(loadTime) };
	if (gravityCurve.empty()) return load;
	load.ofGravity       = gravityFactorAt(time);
	load.growthOfGravity = gravityFactorAt(time) - gravityFactorAt(loadTime);
	return load;
}

template <int Dim> void MpmImplicitEngine::step()
{
	const AtWork           during;
	Real                   target    = 0;
	double                 gathering = 0, checking = 0;
	gimpm::Model<Dim>      model;
	gimpm::PointCloud<Dim> cloud;
	{
		const ValueLock lock;
		requireRunnable();
		progressLine.start(scene->iter);
		warnOfEnd();
		target = scene->time + scene->dt;
		{
			const gimpm::Stopwatch watch(gathering);
			model  = toModel<Dim>(*grid, basis, boundaries, *ghost, *newton);
			updateMaterialPoints(points, *scene, mask);
			if (points.empty()) throw std::invalid_argument(noPoints());
			cloud = gather(points, model);
		}
		plausibility.requireSettings(*this);
		if (plausibility.isNew(cloud)) {
			const gimpm::Stopwatch watch(checking);
			plausibility.requirePoints(points, cloud);
		}
		plausibility.requireGrid(*this);
		for (const string& doubt : plausibility.warnings(*this, points, cloud, model))
			warn(doubt);
		last = gimpm::StepReport();
		times.clear();
		iterations = lineSearchTrials = reusedFactors = luSolves = cgIterations = cgFallbacks = substeps = cuts = 0;
	}
	addTime("gather", gathering);
	if (checking > 0) addTime("check", checking);
	warnOfIdleBoundaries();
	tellObservers([this](LoadStepObserver& observer) { observer.stepBegins(*this); });
	advance(cloud, model, target);
	const ValueLock lock;
	for (const string& doubt : plausibility.warningsOfResult(*this, points, cloud))
		warn(doubt);
}

// Load steps up to the target: a step that fails is undone and tried with half the increment, down to newton.minStep; after an easy
// one the increment doubles. All parts are halves of halves of the whole, so that their sum is exact.
template <int Dim>
void MpmImplicitEngine::advance(gimpm::PointCloud<Dim>& cloud, gimpm::Model<Dim>& model, Real target)
{
	const Real   begin = loadTime;
	Interruption interruption;
	model.newton.interrupted = [&] { return interruption.isRequested(); };
	for (Real done = 0; done < 1;) {
		Real                      part = 0, time = 0;
		bool                      predicts = false;
		gimpm::Load<Dim>          load;
		gimpm::LastIncrement<Dim> last;
		{
			const ValueLock lock;
			part = std::min(stepPart, 1 - done);
			time = done + part == 1 ? target : begin + (done + part) * (target - begin);
			load = loadAt<Dim>(time);
			model.newton.acceptUnconverged = newton->acceptUnconverged && part / 2 < newton->minStep;
			predicts = newton->predictor;
			if (predicts) last = lastIncrement<Dim>(lastDisplacements, lastLoadIncrement);
		}
		const gimpm::StepReport report = gimpm::loadStep(cloud, model, load, solver, predicts ? &last : nullptr);
		const ValueLock         lock;
		take(report);
		lastDisplacements = flat(last);
		lastLoadIncrement = last.load;
		if (report.converged() || report.accepted) {
			if (report.accepted) warnOfAccepted(report, time);
			done += part;
			reach(cloud, time, load.factor);
			if (report.iterations <= newton->maxIterations / 3) stepPart = std::min(1., 2 * stepPart);
		} else if (canBeCut(report.failure) && part / 2 >= newton->minStep) {
			stepPart = part / 2;
			++cuts;
		} else {
			stepPart = 1;
			const string reason = reasonOf(report, time, part);
			if (report.failure == gimpm::Failure::interrupted) interruption.raise(reason);
			throw std::runtime_error(reason);
		}
		showProgress(points.size(), done == 1);
	}
}

// Points and load time move on together: whoever reads or saves the scene at any moment finds a converged state.
template <int Dim> void MpmImplicitEngine::reach(const gimpm::PointCloud<Dim>& cloud, Real time, Real factor)
{
	double scattering = 0;
	{
		const gimpm::Stopwatch watch(scattering);
		scatter(cloud, points);
	}
	addTime("scatter", scattering);
	plausibility.know(cloud);
	++substeps;
	loadTime   = time;
	loadFactor = factor;
}

void MpmImplicitEngine::take(const gimpm::StepReport& report)
{
	last           = report;
	converged      = report.converged();
	residual       = report.residual();
	residuals      = report.residuals;
	if (report.converged() || report.accepted) reactions = report.reactions;
	activeCells    = report.populatedCells;
	boundaryCells  = report.boundaryCells;
	ghostFaces     = report.ghostFaces;
	dofs           = report.dofs;
	clampedDomains = report.clampedDomains;
	wallOverlap    = report.largestWallOverlap;
	iterations += report.iterations;
	lineSearchTrials += report.lineSearchTrials;
	reusedFactors += report.reusedFactors;
	luSolves += report.luSolves;
	cgIterations += report.conjugateGradients.iterations;
	cgFallbacks += report.conjugateGradients.fallbacks;
	const auto& t = report.times;
	for (const auto& [phase, seconds] : { std::pair { "basis", t.basis },
	                                      { "ghost", t.ghost },
	                                      { "assembly", t.assembly },
	                                      { "analyse", t.linear.analyse },
	                                      { "factorise", t.linear.factorise },
	                                      { "solve", t.linear.solve },
	                                      { "update", t.update } })
		addTime(phase, seconds);
}

void MpmImplicitEngine::addTime(const char* phase, double seconds)
{
	timingDeltas->add(phase, std::chrono::nanoseconds(std::llround(1e9 * seconds)));
	times[phase] += seconds;
}

py::dict MpmImplicitEngine::report() const
{
	const ValueLock lock;
	py::dict        result;
	if (times.empty()) return result;
	result["loadTime"]         = loadTime;
	result["loadFactor"]       = loadFactor;
	result["stepPart"]         = stepPart;
	result["iterations"]       = iterations;
	result["substeps"]         = substeps;
	result["cuts"]             = cuts;
	result["lineSearchTrials"] = lineSearchTrials;
	result["reusedFactors"]    = reusedFactors;
	result["luSolves"]         = luSolves;
	result["cgIterations"]     = cgIterations;
	result["cgFallbacks"]      = cgFallbacks;
	result["converged"] = last.converged();
	result["accepted"]  = last.accepted;
	result["failure"]   = nameOf(last.failure);
	result["cause"]     = last.cause;
	py::list history;
	for (const Real r : last.residuals)
		history.append(r);
	result["residuals"]      = history;
	result["residual"]       = last.residual();
	result["localResidual"]  = last.localResidual;
	result["stiffness"]      = nameOf(last.definiteness);
	result["worstNode"]      = Vector3r(last.worst.position);
	result["worstAxis"]      = last.worst.axis < 0 ? string() : string(1, "xyz"[last.worst.axis]);
	result["worstForce"]     = last.worst.force;
	result["points"]         = points.size();
	result["nodes"]          = last.nodes;
	result["dofs"]           = last.dofs;
	result["activeCells"]    = last.populatedCells;
	result["boundaryCells"]  = last.boundaryCells;
	result["ghostFaces"]     = last.ghostFaces;
	result["clampedDomains"] = last.clampedDomains;
	result["wallOverlap"]    = last.largestWallOverlap;
	result["mixedCells"]     = last.mixedCells;
	result["islands"]        = last.parts;
	py::dict seconds;
	for (const auto& [phase, time] : times)
		seconds[phase] = time;
	result["times"] = seconds;
	return result;
}

void MpmImplicitEngine::warn(const string& text)
{
	progressLine.breakLine();
	log(Severity::warning, staticName(), text);
}

void MpmImplicitEngine::warnOfEnd()
{
	if (warnedOfEnd || std::max(loadCurve.size(), gravityCurve.size()) < 2 || loadTime < loadsEnd() - 1e-9 * scene->dt) return;
	warnedOfEnd = true;
	std::ostringstream text;
	text << (gravityCurve.size() < 2 ? "loadCurve has" : "loadCurve and gravityCurve have") << " ended at time " << loadsEnd() << ": the load factor stays at "
	     << loadCurve.back().second
	     << ". Unless something else changes, further steps move the points a little only, as each finds equilibrium on the grid that has been reset.";
	warn(text.str());
}

// A wall may wait for soil that arrives later, so it is said once. That a boundary moves nothing is an error of the step.
void MpmImplicitEngine::warnOfIdleBoundaries()
{
	const ValueLock lock;
	if (boundaries == lookedAtBoundaries) return;
	auto except = std::exchange(lookedAtBoundaries, boundaries);
	std::copy_if(boundaries.begin(), boundaries.end(), std::back_inserter(except), [](const auto& b) { return !b->displacement.isZero(0); });
	const string idle = boundaries.empty() ? "" : idleBoundaries(*this, points, except);
	if (idle.empty()) return;
	warn(idle.substr(1) + " It holds nothing until soil arrives there.");
}

void MpmImplicitEngine::warnOfAccepted(const gimpm::StepReport& report, Real time)
{
	std::ostringstream text;
	text << "the load step from factor " << loadFactor << " to " << loadFactorAt(time) << " has not converged and is accepted (newton.acceptUnconverged): "
	     << report.cause << ".";
	warn(text.str());
}

string MpmImplicitEngine::reasonOf(const gimpm::StepReport& report, Real time, Real part) const
{
	std::ostringstream text;
	text << "MpmImplicitEngine: the load step from factor " << loadFactor << " to " << loadFactorAt(time);
	if (!gravityCurve.empty()) text << ", of gravity from " << gravityFactorAt(loadTime) << " to " << gravityFactorAt(time) << ",";
	if (part < 1) text << " (" << part << " of O.dt, after " << cuts << " cuts)";
	text << " failed: " << report.cause;
	if (report.failedPoint >= 0) text << placeOf(points[report.failedPoint]);
	text << "." << placeOfImbalance(report) << adviceOn(report, part);
	if (report.failure == gimpm::Failure::unrestrained) text << idleBoundaries(*this, points);
	text << " The scene is at load factor " << loadFactor << ", the last converged state, in iteration " << scene->iter << ".";
	return text.str();
}

string MpmImplicitEngine::placeOfImbalance(const gimpm::StepReport& report) const
{
	if (report.residuals.empty() || report.worst.axis < 0) return "";
	std::ostringstream text;
	text << " Residuals:";
	for (const Real r : report.residuals)
		text << " " << r;
	text << "; largest out-of-balance force " << report.worst.force << " N along " << "xyz"[report.worst.axis] << " at node ("
	     << report.worst.position.head(grid->dim).transpose() << ")";
	constexpr int listed = 5;
	int           found  = 0;
	for (const MaterialPoint& point : points)
		if ((point.state->pos - report.worst.position).head(grid->dim).cwiseAbs().maxCoeff() < grid->cellSize && ++found <= listed)
			text << (found == 1 ? ", near it bodies #" : ", #") << point.id;
	if (found > listed) text << " and " << found - listed << " more";
	text << ".";
	return text.str();
}

string MpmImplicitEngine::adviceOn(const gimpm::StepReport& report, Real part) const
{
	using gimpm::Failure;
	string advice;
	if (report.failure == Failure::unrestrained) return " Hold nodes of that material with MpmBoundary.";
	if (report.failure == Failure::interrupted) return " O.run() goes on from there.";
	if (report.failure == Failure::stalled) return " Set newton.tolerance to that or more.";
	if (report.failure == Failure::detached)
		return " Nodes stay in place while the soil moves: on its surface they push it by half a cell, see MpmBoundary.displacement. Put the box where the soil is now, "
		       "or move a block of stiff material points by nodes inside of it.";
	if (ghost->factor == 0) advice += " The ghost stabilisation is off (factor=0): small overlaps of material and cells make the system ill conditioned.";
	if (part < 1) advice += " The load may be more than the body can carry in equilibrium.";
	else
		advice += " Smaller load steps (O.dt), or newton.minStep < 1, may help.";
	if (report.clampedDomains > 0) advice += " " + std::to_string(report.clampedDomains) + " domains had outgrown half a cell.";
	return advice;
}

template <class F> auto MpmImplicitEngine::onCurrentState(F f)
{
	const Threads threads(ompThreads);
	const auto    inSpace = [&](auto dim) {
		constexpr int          Dim = decltype(dim)::value;
		gimpm::Model<Dim>      model;
		gimpm::PointCloud<Dim> cloud;
		{
			const ValueLock lock;
			requireAdmissible();
			model = toModel<Dim>(*grid, basis, boundaries, *ghost, *newton);
			cloud = gather(materialPoints(*ownScene(), mask), model);
		}
		const PythonUnlock python;
		return f(cloud, model);
	};
	return grid && grid->dim == 3 ? inSpace(std::integral_constant<int, 3>()) : inSpace(std::integral_constant<int, 2>());
}

gimpm::SymmetricCsc MpmImplicitEngine::reducedStiffness()
{
	return onCurrentState([](const auto& cloud, const auto& model) { return gimpm::tangentStiffness(cloud, model); });
}

py::tuple MpmImplicitEngine::stiffness()
{
	const auto      K = reducedStiffness();
	vector<int64_t> rows, columns;
	vector<Real>    values;
	for (int c = 0; c < K.size(); ++c)
		for (int e = K.start[c]; e < K.start[c + 1]; ++e)
			for (const auto& [row, column] : { std::pair { K.row[e], c }, std::pair { c, K.row[e] } }) {
				rows.push_back(row);
				columns.push_back(column);
				values.push_back(K.value[e]);
				if (row == column) break;
			}
	return py::make_tuple(numpyArray(rows, "int64"), numpyArray(columns, "int64"), numpyArray(values, "float64"), K.size());
}

Real MpmImplicitEngine::conditionNumber()
{
	constexpr int largest = 4000;
	const auto    K       = reducedStiffness();
	if (K.size() > 0 && K.size() <= largest) return gimpm::conditionNumber(K);
	throw std::invalid_argument(
	        "MpmImplicitEngine.conditionNumber() needs all eigenvalues: the scene has " + std::to_string(K.size()) + " unknowns, admitted are 1 to "
	        + std::to_string(largest) + ".");
}

Real MpmImplicitEngine::conditionEstimate()
{
	const auto K = reducedStiffness();
	if (K.size() == 0) throw std::invalid_argument("MpmImplicitEngine.conditionEstimate(): the scene has no unknowns.");
	return gimpm::conditionEstimate(K);
}

py::dict MpmImplicitEngine::workload()
{
	// the quickest of three: other programs can only slow them down
	double          perStep = std::numeric_limits<double>::infinity(), perSolve = perStep;
	gimpm::Workload w;
	for (int time = 0; time < 3; ++time) {
		double gathering = 0, rest = 0;
		{
			const gimpm::Stopwatch watch(gathering);
			w = onCurrentState([&](const auto& cloud, const auto& model) {
				const gimpm::Stopwatch watch(rest);
				return gimpm::workload(cloud, model);
			});
		}
		const auto& t = w.times;
		// scattering takes as long as gathering, the update of the points and the last residual as long as an assembly
		perStep  = std::min(perStep, 2 * (gathering - rest) + t.basis + t.ghost + t.linear.analyse + t.assembly);
		perSolve = std::min(perSolve, t.assembly + t.linear.factorise + t.linear.solve);
	}
	py::dict d;
	d["points"]          = w.points;
	d["nodes"]           = w.nodes;
	d["dofs"]            = w.dofs;
	d["activeCells"]     = w.populatedCells;
	d["ghostFaces"]      = w.ghostFaces;
	d["blockEntries"]    = w.blockEntries;
	d["matrixEntries"]   = w.matrixEntries;
	d["factorEntries"]   = w.factorEntries;
	d["factorFlops"]     = w.factorFlops;
	d["secondsPerStep"]  = perStep;
	d["secondsPerSolve"] = perSolve;
	return d;
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmImplicitEngine)
static const yade::PluginClasses<yade::MpmImplicitEngine> registered(__FILE__);
