// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/MpmImplicitEngine.hpp"
#include "core/base/stopwatch.hpp"
#include "core/stepping/load_step.hpp"
#include "engine/solver/AtWork.hpp"
#include "engine/solver/LoadStepObserver.hpp"
#include "engine/solver/Threads.hpp"
#include "engine/solver/build_model.hpp"
#include "engine/solver/exchange.hpp"
#include "engine/solver/failures.hpp"
#include "engine/solver/movers.hpp"
#include "engine/solver/moving.hpp"
#include "engine/solver/processes.hpp"
#include "engine/solver/progress.hpp"
#include "engine/solver/requirements.hpp"
#include "engine/solver/step_errors.hpp"
#include "engine/solver/walls.hpp"
#include "yade_api/exceptions.hpp"
#include "yade_api/logging.hpp"
#include "yade_api/registration.hpp"

namespace yade {

MpmImplicitEngine::MpmImplicitEngine()
{
	iterPeriod   = 1;
	initRun      = true;
	timingDeltas = boost::make_shared<TimingDeltas>();
	if (scene) home = scene->weak_from_this(); // the current one
}

void MpmImplicitEngine::action()
{
	deliveringErrors([&] {
		home = scene->weak_from_this();
		requireCallable(getClassName());
		Agreement agreement;
		try {
			const Threads threads(ompThreads);
			grid && grid->dim == 3 ? step<3>(agreement) : step<2>(agreement);
		} catch (...) {
			agreement.breakOff(std::current_exception());
			beforeActivation.putBack(*this);
			if (!scene->subStepping) scene->subStep = -1; // YADE would count the iteration as begun, and finish it later
			progressLine.end();
			tellObservers(*scene, [this](LoadStepObserver& observer) { observer.stepEnds(*this, false); });
			throw;
		}
		handOver(contacts, *scene, false);
		tellObservers(*scene, [this](LoadStepObserver& observer) { observer.stepEnds(*this, true); });
	});
}

template <int Dim> void MpmImplicitEngine::step(Agreement& agreement)
{
	const AtWork during;
	if (!water.empty()) askWater<Dim>(agreement);
	Job<Dim> job      = prepare<Dim>(agreement);
	double   agreeing = 0;
	if (job.model.grid.refinement && basis == "gimp" && splitOutgrown(job)) job = prepare<Dim>(agreement);
	{
		const gimpm::Stopwatch watch(agreeing);
		agreement.reach(*this, job.cloud, *job.model.division);
	}
	if (job.model.processes->size() > 1) addTime(*timingDeltas, "agree", agreeing);
	doubt(job);
	tellObservers(*scene, [this](LoadStepObserver& observer) { observer.stepBegins(*this); });
	advance(job);
	const ValueLock lock;
	for (const auto& [about, doubt] : job.contacts.doubts(isDynamic()))
		warn(plausibility.once(about, doubt));
	if (job.moving && job.contacts.areThere()) warn(plausibility.once("gift", job.moving->doubtOfContact()));
	if ((maxSplits > 0 || job.model.grid.refinement) && clampedDomains > 0) splitOutgrown(job);
	const auto doubts = plausibility.warningsOfResult(*this, points, job.cloud);
	warnOfPoints(doubts.empty() ? "" : doubts.front());
}

template <int Dim> Job<Dim> MpmImplicitEngine::prepare(Agreement& agreement)
{
	const ValueLock lock;
	requireRunnable(*this);
	join();
	progressLine.start(scene->iter);
	warn(doubtOfAbsence());
	warn(plausibility.doubtOfEnd(*this));
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
	job.doubts = plausibility.look(*this, points, job.cloud, job.model, checking);
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
		Attempt<Dim>    tried  = errors.next(job, [&] { return attempt(job); });
		const auto      report = isExplicit() ? job.moving->step(job, tried)
		                                      : gimpm::loadStep(job.cloud, job.model, tried.load, solver, tried.predicts ? &tried.last : nullptr);
		const ValueLock lock;
		take(report, *timingDeltas);
		lastDisplacements = toNumbers(tried.last, job.model.grid), lastLoadIncrement = tried.last.load;
		const Real part   = job.control.part();
		const bool goesOn = job.control.take(report);
		cuts = job.control.cuts(), stepPart = job.control.nextPart();
		if (!goesOn) {
			const string reason = reasonOf(report, *this, points, tried.time, part);
			if (report.failure == gimpm::Failure::interrupted) interruption.raise(reason);
			throw std::runtime_error(reason);
		}
		warn(report.accepted ? warningOfAccepted(report, *this, tried.time) : errors.doubtOf(report, job.control));
		if (report.converged() || report.accepted) reach(job, tried);
		progressLine.show(progressOf(*this, job.control.isDone()), isFirstProcess() ? verbosity : 0);
	}
}

template <int Dim> Attempt<Dim> MpmImplicitEngine::attempt(Job<Dim>& job) const
{
	const ValueLock lock;
	const Real      time               = job.control.goal() == 1 ? job.target : job.begin + job.control.goal() * (job.target - job.begin);
	job.model.newton.acceptUnconverged = newton->acceptUnconverged && job.control.isLeast();
	Attempt<Dim> next { time, loadBetween<Dim>(loadTime, time), newton->predictor, {} };
	if (yade::advance<Dim>(job, *this, loadTime, time)) next.load.motion = time - loadTime;
	if (job.moving) job.moving->begin(job, next, loadTime);
	if (next.predicts) next.last = fromNumbers<Dim>(lastDisplacements, lastLoadIncrement, job.model.grid);
	return next;
}

// Points and load time move on together: whoever reads or saves the scene at any moment finds a converged state.
template <int Dim> void MpmImplicitEngine::reach(Job<Dim>& job, const Attempt<Dim>& made)
{
	double scattering = 0;
	job.contacts.requireStable();
	{
		const gimpm::Stopwatch watch(scattering);
		if (job.moving) job.moving->reach(job, made.time, points);
		scatter(job.cloud, job.model.grid, points);
		job.surfaceLoads.scatter();
		job.contacts.scatter(made.time);
		scatterWalls(job.model, boundaries);
		job.waters.scatter(points, job.model.boundary, reactions);
	}
	addTime(*timingDeltas, "scatter", scattering);
	plausibility.know(job.cloud);
	++substeps;
	loadTime = made.time, loadFactor = made.load.factor.value;
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
