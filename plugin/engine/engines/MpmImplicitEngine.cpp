// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/engines/MpmImplicitEngine.hpp"
#include "core/base/stopwatch.hpp"
#include "core/stepping/load_step.hpp"
#include "core/stepping/nonlocal.hpp"
#include "engine/analysis/LoadStepObserver.hpp"
#include "engine/analysis/exchange.hpp"
#include "engine/analysis/movers.hpp"
#include "engine/conditions/boundary/MpmBoundary.hpp"
#include "engine/conditions/flow/MpmFlow.hpp"
#include "engine/conditions/water/MpmWater.hpp"
#include "engine/engines/Threads.hpp"
#include "engine/engines/adaptation.hpp"
#include "engine/engines/build_model.hpp"
#include "engine/engines/cell_sizes.hpp"
#include "engine/engines/merging.hpp"
#include "engine/engines/moving.hpp"
#include "engine/engines/step_errors.hpp"
#include "engine/messages/failures.hpp"
#include "engine/messages/progress.hpp"
#include "engine/messages/requirements.hpp"
#include "engine/messages/slips.hpp"
#include "engine/parallel/common_state.hpp"
#include "engine/parallel/pieces.hpp"
#include "engine/parallel/processes.hpp"
#include "engine/points/AtWork.hpp"
#include "yade_api/exceptions.hpp"
#include "yade_api/logging.hpp"
#include "yade_api/registration.hpp"
#include "yade_api/value_lock.hpp"
#include <numeric>

namespace yade {

MpmImplicitEngine::MpmImplicitEngine()
{
	iterPeriod   = 1;
	initRun      = true;
	timingDeltas = boost::make_shared<TimingDeltas>();
	if (scene) home = scene->weak_from_this(); // the current one
}

vector<Listed> MpmImplicitEngine::conditions() const
{
	vector<Listed> all;
	const auto     add = [&](const char* list, const auto& conditions) {
                for (size_t i = 0; i < conditions.size(); ++i)
                        all.push_back({ conditions[i], list, i, conditions.size() });
	};
	add("boundaries", boundaries);
	add("loads", loads);
	add("water", water);
	add("contacts", contacts);
	if (flow) all.push_back({ flow, "flow", 0, 1 });
	return all;
}

bool MpmImplicitEngine::areContacts(const vector<shared_ptr<MpmCondition>>& conditions)
{
	return std::all_of(conditions.begin(), conditions.end(), [](const auto& one) { return one && string(one->list()) == "contacts"; });
}

bool MpmImplicitEngine::areLoads(const vector<shared_ptr<MpmCondition>>& conditions)
{
	return std::all_of(conditions.begin(), conditions.end(), [](const auto& one) { return string(one->list()) == "loads"; });
}

void MpmImplicitEngine::handOver(bool isBetween)
{
	const ValueLock lock;
	for (const Listed& listed : conditions())
		listed.condition->actOnBodies(*scene, isBetween);
}

shared_ptr<Scene> MpmImplicitEngine::ownScene() const
{
	const auto& current = Singleton<Omega>::instance().getScene();
	const auto  holds
	        = [this](const Scene& s) { return std::any_of(s.engines.begin(), s.engines.end(), [this](const auto& e) { return e.get() == this; }); };
	if (holds(*current)) home = current;
	const auto other = boost::dynamic_pointer_cast<Scene>(home.lock());
	return other && holds(*other) ? other : current;
}

bool MpmImplicitEngine::isActivated()
{
	beforeActivation.keep(*this);
	join();
	wasAway          = wasAway || (seen >= 0 && scene->iter > seen + 1);
	seen             = scene->iter;
	const bool isDue = PeriodicEngine::isActivated(), ends = !isDue && isEndOfLoads();
	nDone += ends;
	if (!isDue && !ends) handOver(true);
	return isDue || ends;
}

// Grains may have been poured for a while before. What has run, or was given another time, goes on from there.
void MpmImplicitEngine::join()
{
	const ValueLock lock;
	if (!hasJoined && nDone == 0 && loadTime == 0) loadTime = scene->time;
	hasJoined = true;
}

// YADE asks no engine that is dead, or not among O.engines.
string MpmImplicitEngine::warningOfAbsence()
{
	const Real goal = scene->time + scene->dt;
	if (!wasAway || goal <= loadTime) return "";
	wasAway = false;
	std::ostringstream text;
	text << "it was dead or out of O.engines for some time: this step makes up for that and goes from loadTime = " << loadTime << " to " << goal
	     << " s at once. Where the soil shall have stood still, set loadTime = O.time first.";
	return text.str();
}

// An engine that does not run in every iteration would leave out the end of the load curve, where a run usually stops.
bool MpmImplicitEngine::isEndOfLoads() const
{
	const ValueLock lock;
	if (nDone == 0 || (nDo >= 0 && nDone >= nDo) || loadCurve.empty()) return false;
	const Real reached = loadsEnd() - 1e-9 * scene->dt;
	return loadTime < reached && scene->time + scene->dt >= reached;
}

void MpmImplicitEngine::action()
{
	deliveringErrors(*scene, [&] {
		home = scene->weak_from_this();
		requireCallable(getClassName());
		Agreement agreement;
		try {
			const Threads threads(ompThreads);
			grid && grid->dim == 3 ? step<3>(agreement) : step<2>(agreement);
		} catch (...) {
			agreement.breakOff(std::current_exception());
			beforeActivation.putBack(*this);
			// YADE would count the iteration as begun, and finish it later.
			if (!scene->subStepping) scene->subStep = -1;
			progressLine.end();
			tellObservers(*scene, [this](LoadStepObserver& observer) { observer.stepEnds(*this, false); });
			throw;
		}
		handOver(false);
		tellObservers(*scene, [this](LoadStepObserver& observer) { observer.stepEnds(*this, true); });
	});
}

// The search goes over all points, and a face that stands goes on standing: it is looked at in every tenth step, when
// soil has come or gone, and where the loads have come to rest, at which most runs end.
bool MpmImplicitEngine::isTimeForSlips(Real begin)
{
	constexpr long every = 10;
	if (plausibility.hasSaid("planeSlip")) return false;
	const bool isChanged = std::exchange(pointsOfSlips, points.size()) != points.size();
	const Real end       = loadsEnd() - 1e-9 * scene->dt;
	return isChanged || nDone % every == 1 || (loadTime >= end && begin < end);
}

template <int Dim> void MpmImplicitEngine::step(Agreement& agreement)
{
	const AtWork during;
	double       adapting = 0;
	askSizes(*this, *scene, mask);
	adaptCells(adapting);
	lookAtBodies();
	if (hasQuestions()) askFunctions<Dim>(agreement);
	Job<Dim> job      = prepare<Dim>(agreement);
	double   agreeing = 0;
	if (job.model.grid.refinement && basis == "gimp" && splitOutgrown(job)) job = prepare<Dim>(agreement);
	if (adapting > 0) addTime(*timingDeltas, "adapt", adapting);
	{
		const gimpm::Stopwatch watch(agreeing);
		agreement.reach(*this, job.cloud, *job.model.division);
	}
	if (job.model.processes->size() > 1) addTime(*timingDeltas, "agree", agreeing);
	warnOf(job);
	tellObservers(*scene, [this](LoadStepObserver& observer) { observer.stepBegins(*this); });
	advance(job);
	const ValueLock lock;
	for (const auto& condition : job.conditions)
		for (const auto& [about, warning] : condition->warnings())
			warn(plausibility.once(about, warning));
	warn(plausibility.once("noUnknowns", warningOfNoUnknowns(*this)));
	if (job.moving) warn(plausibility.once("gift", job.moving->warningOfContact()));
	else {
		warn(plausibility.once("ghostShare", warningOfShare(*this)));
		warn(plausibility.once("loosePoints", warningOfLoosePoints(*this)));
		if (isTimeForSlips(job.begin)) warn(plausibility.once("planeSlip", warningOfSlip(*this, points, job.cloud, job.model)));
	}
	if ((maxSplits > 0 || job.model.grid.refinement) && clampedDomains > 0) splitOutgrown(job);
	const auto warnings = plausibility.warningsOfResult(*this, points, job.cloud);
	warnOfPoints(warnings.empty() ? "" : warnings.front());
	if (job.model.division->isWhole()) columns.keep(std::move(job.cloud), job.model.materials);
}

// Cells follow what moves, before anything is asked about them.
void MpmImplicitEngine::adaptCells(double& time)
{
	const ValueLock lock;
	if (!grid || (grid->adaptation.empty() && grid->adapted.empty())) return;
	const gimpm::Stopwatch watch(time);
	requireRunnable(*this);
	updateMaterialPoints(points, *scene, mask);
	warn(plausibility.once("maxUnknowns", adapt(*this, *scene, points)));
	const bool areKnown = grid->dim == 3 ? plausibility.knows<3>(points) : plausibility.knows<2>(points);
	mergedEnergy += mergeHalves(*this, *scene, points);
	if (areKnown) grid->dim == 3 ? plausibility.know<3>(points) : plausibility.know<2>(points);
}

// Bodies fall into parts, or come to stick to each other.
void MpmImplicitEngine::lookAtBodies()
{
	const ValueLock lock;
	if (!grid || grid->bodies.empty()) return;
	const bool sticks = sticking.mayBegin(*this);
	if (!bodiesMeet() && !sticks) return;
	requireRunnable(*this);
	updateMaterialPoints(points, *scene, mask);
	for (const Listed& listed : conditions())
		warn(plausibility.once("parts", listed.condition->divideBodies(*this, points)));
	if (sticks) warn(sticking.warning(*this, points));
}

bool MpmImplicitEngine::hasQuestions() const
{
	const auto all = conditions();
	return std::any_of(all.begin(), all.end(), [](const Listed& listed) { return listed.condition->hasQuestions(); });
}

// Nothing is asked while the lock of values is held, since a function may well ask the engine. Whether any was asked.
template <int Dim> bool MpmImplicitEngine::ask(const gimpm::Grid<Dim>& lattice, const vector<gimpm::Key>& cells) const
{
	for (bool isAsked = false;; isAsked = true) {
		std::unique_ptr<Question> question;
		vector<Listed>            asked; // lives on meanwhile
		{
			const ValueLock lock;
			asked    = conditions();
			question = nextQuestion<Dim>(asked, lattice, cells);
		}
		if (!question) return isAsked;
		question->ask();
		const ValueLock lock;
		question->store();
	}
}

// Functions of conditions, as of the pressure of water, answer before the step begins, and before anything is taken
// over from the scene, which they may ask and even change: then they are asked about what there is now.
template <int Dim> void MpmImplicitEngine::askFunctions(Agreement& agreement)
{
	constexpr int mostTimes = 100;
	{
		const ValueLock lock;
		for (const Listed& listed : conditions())
			listed.condition->forgetAnswers();
	}
	for (int time = 0; time < mostTimes; ++time) {
		gimpm::Grid<Dim>   lattice;
		vector<gimpm::Key> cells;
		{
			const ValueLock lock;
			requireRunnable(*this);
			grid->requireAdmissible();
			lattice = grid->lattice<Dim>();
			updateMaterialPoints(points, *scene, mask);
			cells = cellsOf(centresOnGrid(points, lattice), lattice);
		}
		if (distributed) {
			agreement.meet(*this);
			cells = gimpm::united(*processes(), std::move(cells));
		}
		if (!ask<Dim>(lattice, cells)) return;
	}
	throw std::invalid_argument(
	        getClassName()
	        + ": a function of its conditions, as MpmWater.pressure, brings other material points into the scene whenever it is asked; it must only answer.");
}

template <int Dim> void MpmImplicitEngine::takePoints(Setup<Dim>& to, Agreement& agreement)
{
	auto& model     = to.model;
	model.processes = processes();
	updateMaterialPoints(points, *scene, mask);
	Distribution::requireWhole(*this);
	if (!isDivided(*this)) requireAny(points, *this);
	vector<const MpmMaterial*> known;
	bool                       areKnown = false;
	if (distributed && model.processes->size() > 1) {
		Distribution::requireDivisible(*this, points);
		agreement.meet(*this);
		std::int64_t isKnown = plausibility.knows<Dim>(points);
		model.processes->smallest(&isKnown, 1);
		areKnown       = isKnown;
		model.division = distribution.divide<Dim>(*this, points);
		known          = materialsOfAll(*scene, points, *model.processes);
	}
	requireSeconds(*this, points);
	to.cloud = gather(points, model, known, columns.take<Dim>());
	if (areKnown) plausibility.know(to.cloud); // some have come from another process
	if (!model.division->isWhole() && hasQuestions()) agreement.meet(*this);
}

Body::id_t MpmImplicitEngine::add(NewPoints& added)
{
	const ValueLock lock;
	const auto      all = distributed ? processes() : gimpm::Processes::alone();
	vector<int>     own(added.size());
	std::iota(own.begin(), own.end(), 0);
	if (all->size() > 1) own = grid->dim == 3 ? distribution.ownOf<3>(*this, points, added) : distribution.ownOf<2>(*this, points, added);
	vector<shared_ptr<Body>> bodies;
	const auto               make = [&] {
                for (const int i : own)
                        bodies.push_back(added.body(i));
	};
	together(make, *all);
	const Body::id_t first = scene->bodies->size();
	for (size_t i = 0; i < own.size(); ++i)
		scene->bodies->insertAtId(bodies[i], first + own[i]);
	if (all->size() == 1) return first;
	provideGaps(*scene, first + added.size());
	Pieces::note(*scene, *all);
	return first;
}

void MpmImplicitEngine::lookAtPlaced(const vector<Body::id_t>& ids)
{
	if (!grid) return;
	const std::set<Body::id_t> known(ids.begin(), ids.end());
	vector<MaterialPoint>      placed;
	for (const MaterialPoint& point : materialPoints(*ownScene(), mask))
		if (known.count(point.id)) placed.push_back(point);
	warnOfPoints(grid->dim == 3 ? plausibility.warningOfPlaced(placed, grid->lattice<3>()) : plausibility.warningOfPlaced(placed, grid->lattice<2>()));
}

template <int Dim> void MpmImplicitEngine::warnOf(const Job<Dim>& job)
{
	const ValueLock lock;
	const auto&     division = *job.model.division;
	requireSameAnswers(*division.processes, *this);
	pointsOfRun = size_t(division.sum(Real(points.size())));
	// The same in all processes.
	const int own = int(job.warnings.size()), count = largestOf(own, *division.processes);
	for (int i = 0; i < count; ++i)
		warnOfPoints(i < own ? job.warnings[i] : "");
	warn(plausibility.warningOfPlaces(*this, points));
	if (!division.isWhole()) return;
	for (const auto& condition : job.conditions)
		warn(condition->warningOfPlace(job.cloud, job.model.grid));
}

// False if there are no points to be split.
template <int Dim> bool MpmImplicitEngine::splitOutgrown(Job<Dim>& job)
{
	const ValueLock lock;
	const size_t    before = points.size();
	warn(splitting.split(*this, points, job));
	plausibility.know(job.cloud);
	return points.size() > before;
}

// Warns about points that this process has. Where they are divided, the others may have a reason, too, and one of them
// is heard.
void MpmImplicitEngine::warnOfPoints(const string& text) { warn(gimpm::firstSaid(*holdersOf(*this), text)); }

template <int Dim> Job<Dim> MpmImplicitEngine::prepare(Agreement& agreement)
{
	const ValueLock lock;
	requireRunnable(*this);
	join();
	progressLine.start(scene->iter);
	warn(warningOfAbsence());
	warn(plausibility.warningOfEnd(*this));
	const Real target    = scene->time + scene->dt;
	double     gathering = 0, checking = 0;
	Job<Dim>   job = [&] {
                const gimpm::Stopwatch   watch(gathering);
                const gimpm::StepControl control(stepPart, isExplicit() ? 1 : newton->minStep, newton->maxIterations);
                auto                     setup = buildModel<Dim>(*this, *scene, points, loadTime, target, [&](Setup<Dim>& to) { takePoints(to, agreement); });
                Job<Dim>                 made(std::move(setup), control, loadTime, target);
                Movers(*scene).requireOthers(points, *scene, isDynamic());
                setMoving(made, points); // inertia comes last
                return made;
	}();
	job.warnings = plausibility.look(*this, points, job.cloud, job.model, checking);
	begin(points.size());
	addTime(*timingDeltas, "gather", gathering);
	if (checking > 0) addTime(*timingDeltas, "check", checking);
	return job;
}

// Load steps up to the target, as many as it takes.
template <int Dim> void MpmImplicitEngine::advance(Job<Dim>& job)
{
	Interruption interruption;
	StepErrors   errors(*this);
	job.model.newton.interrupted = [&] { return isRequested(interruption.isRequested(), *job.model.processes); };
	while (!job.control.isDone()) {
		Attempt<Dim> tried = errors.next(job, [&] { return nextIncrement(job); });
		if (nonlocalLength > 0) gimpm::averageSoftening(job.cloud, job.model, nonlocalLength);
		const auto      report = isExplicit() ? job.moving->step(job, tried)
		                                      : gimpm::loadStep(job.cloud, job.model, tried.load, solver, tried.predicts ? &tried.last : nullptr);
		const ValueLock lock;
		take(report, *timingDeltas);
		lastDisplacements = toNumbers(tried.last, job.model.grid), lastLoadIncrement = tried.last.load;
		const Real part   = job.control.part();
		const bool goesOn = job.control.take(report);
		if (job.control.cuts() > cuts) lastCut = report;
		cuts = job.control.cuts(), stepPart = job.control.nextPart();
		if (!goesOn) {
			const string reason = reasonOf(report, *this, points, tried.time, part);
			if (report.failure == gimpm::Failure::interrupted) interruption.raise(reason);
			throw std::runtime_error(reason);
		}
		warn(report.accepted ? warningOfAccepted(report, *this, tried.time) : errors.warningOf(report, job.control));
		if (report.converged() || report.accepted) reach(job, tried);
		progressLine.show(progressOf(*this, job.control.isDone()), isFirstProcess() ? verbosity : 0);
	}
}

template <int Dim> Attempt<Dim> MpmImplicitEngine::nextIncrement(Job<Dim>& job) const
{
	const ValueLock lock;
	const Real      time               = job.control.goal() == 1 ? job.target : job.begin + job.control.goal() * (job.target - job.begin);
	job.model.newton.acceptUnconverged = newton->acceptUnconverged && job.control.isLeast();
	const StepTime step                = job.moving ? job.moving->begin(job, loadTime, time) : StepTime { loadTime, time, time };
	Attempt<Dim>   next { time, yade::advance<Dim>(job, *this, step), newton->predictor, {} };
	if (job.moving) job.moving->weigh(next.load);
	if (next.predicts) next.last = fromNumbers<Dim>(lastDisplacements, lastLoadIncrement, job.model.grid);
	return next;
}

// Points and load time move on together: whoever reads or saves the scene at any moment finds a converged state.
template <int Dim> void MpmImplicitEngine::reach(Job<Dim>& job, const Attempt<Dim>& made)
{
	double scattering = 0;
	for (const auto& condition : job.conditions)
		condition->requireKept();
	const StepOutcome<Dim> outcome { job.model, last, points, loadTime, made.time, reactions, formerReactions() };
	{
		const gimpm::Stopwatch watch(scattering);
		if (job.moving) job.moving->reach(job, outcome);
		scatter(job.cloud, job.model.grid, points);
		columns.wrote();
		for (const auto& condition : job.conditions)
			condition->reach(outcome);
	}
	addTime(*timingDeltas, "scatter", scattering);
	plausibility.know(job.cloud);
	++substeps;
	loadTime = made.time, loadFactor = made.load.factor.value;
}

Body::id_t addPoints(
        const shared_ptr<MpmImplicitEngine>& engine, const py::object& positions, const py::object& half, const py::list& materials, const py::object& index,
        const py::dict& parameters, int body)
{
	if (AtWork::isAny()) throw std::runtime_error("add: a load step is at work in the background; call O.pause() or O.wait() first.");
	NewPoints points(*engine->grid, positions, half, materials, index, parameters, body);
	engine->scene = Singleton<Omega>::instance().getScene().get(); // it may not have seen the scene yet
	return engine->add(points);
}

void MpmImplicitEngine::warn(const string& text)
{
	if (text.empty() || !isFirstProcess()) return;
	progressLine.breakLine();
	log(Severity::warning, staticName(), text);
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmImplicitEngine)
static const yade::PluginClasses<yade::MpmImplicitEngine> registeredMpmImplicitEngine(__FILE__);
