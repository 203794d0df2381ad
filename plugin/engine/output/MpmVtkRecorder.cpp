// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/output/MpmVtkRecorder.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/output/gridCells.hpp"
#include "engine/output/statePieces.hpp"
#include "engine/output/vtkDataSets.hpp"
#include "engine/parallel/distribution.hpp"
#include "engine/parallel/processes.hpp"
#include "engine/points/columns.hpp"
#include "engine/points/parallel.hpp"
#include "yade_api/background.hpp"
#include "yade_api/exceptions.hpp"
#include "yade_api/logging.hpp"
#include "yade_api/registration.hpp"
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vtkUnstructuredGrid.h>

namespace yade {

namespace {
	const vector<string> kinds { "points", "grid", "ghostFaces", "loads", "walls", "contacts" };

	const vector<string>& pointFields()
	{
		static const vector<string> names = [] {
			vector<string> found;
			for (const PointColumn& column : pointColumns())
				if (column.is(PointColumn::inVtk)) found.push_back(column.name);
			found.push_back("clamped"); // depends on the grid
			return found;
		}();
		return names;
	}

	bool contains(const vector<string>& list, const string& item) { return std::find(list.begin(), list.end(), item) != list.end(); }

	Real secondsNow() { return std::chrono::duration<Real>(std::chrono::system_clock::now().time_since_epoch()).count(); }

	bool endsWithThisIteration(const Scene& scene)
	{
		return (scene.stopAtIter > 0 && scene.iter + 1 == scene.stopAtIter) || (scene.stopAtTime > 0 && scene.time + scene.dt >= scene.stopAtTime);
	}

	// True if nothing follows beside which a file could be written: it has to be complete then.
	bool isLastOfRun(const Scene& scene) { return !isRunGoingOn() || endsWithThisIteration(scene); }

	VtkCells pointData(const Scene& scene, const Analysis& solver, const Columns& known, const vector<string>& fields, int sectors)
	{
		if (sectors > 0 && !solver.grid->axisymmetric)
			throw std::invalid_argument(
			        "MpmVtkRecorder.sectors = " + std::to_string(sectors) + ": only what is axisymmetric (MpmGrid.axisymmetric) can be revolved.");
		const ValueLock lock;
		const auto      points = materialPoints(scene, solver.mask);
		inRanges(points.size(), [&](size_t begin, size_t end) {
			for (size_t p = begin; p < end; ++p)
				points[p].requireAdmissible(solver.grid->dim, solver.grid->axisymmetric);
		});
		auto       columns = isDivided(solver) ? known : fieldsOf(points);
		const bool areAll  = contains(fields, "all");
		if (!areAll) {
			const auto isLeftOut = [&](const PointColumn* column) { return !contains(fields, column->name); };
			columns.erase(std::remove_if(columns.begin(), columns.end(), isLeftOut), columns.end());
		}
		return pointDomains(
		        points, scene, *solver.grid, columns, solver.basis == "gimp" ? std::optional(solver.domainRule()) : std::nullopt,
		        areAll || contains(fields, "clamped"), sectors);
	}

	void finishAll()
	{
		{
			const PythonUnlock python;
			endBackgroundRun(); // ends a simulation that still runs when the script has ended
		}
		for (const auto& engine : Singleton<Omega>::instance().getScene()->engines)
			if (auto* recorder = dynamic_cast<MpmVtkRecorder*>(engine.get())) recorder->finish();
	}

	// YADE's script mode ends Python first. Its prompt ends the process with Python alive, and leaves out what
	// Python would do at its end. Called when VTK has been used, so that this comes before VTK's own end.
	bool finishAtExit()
	{
		const PythonLock lock;
		py::import("atexit").attr("register")(py::make_function(&finishAll));
		std::atexit([] {
			if (Py_IsInitialized() && PyGILState_Check()) finishAll();
		});
		return true;
	}
}

MpmVtkRecorder::MpmVtkRecorder()
{
	iterPeriod = 1;
	initRun    = true;
}

MpmVtkRecorder::~MpmVtkRecorder() { settleQuietly(); }

bool MpmVtkRecorder::isFileName(const string& text)
{
	return !text.empty() && std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

bool MpmVtkRecorder::areKinds(const vector<string>& names)
{
	return !names.empty() && std::all_of(names.begin(), names.end(), [](const string& name) { return name == "all" || contains(kinds, name); });
}

const char* MpmVtkRecorder::whichFields()
{
	static const string text = [] {
		string names;
		for (const string& name : pointFields())
			names += name + ", ";
		return "names of the fields of 'points': " + names + "or 'all'";
	}();
	return text.c_str();
}

bool MpmVtkRecorder::areFields(const vector<string>& names)
{
	return std::all_of(names.begin(), names.end(), [](const string& name) { return name == "all" || contains(pointFields(), name); });
}

bool MpmVtkRecorder::isActivated()
{
	bool activated = false;
	deliveringErrors(*scene, [&] {
		if (isLastOfRun(*scene)) settle();
		const Analysis& engine = followed();
		activated              = isDue(momentOf(engine)) || (lastIsMissing() && endsWithThisIteration(*scene) && standsBehind(engine));
	});
	isInRun = activated;
	return activated;
}

void MpmVtkRecorder::action()
{
	const bool isCalledByName = !std::exchange(isInRun, false);
	deliveringErrors(*scene, [&] {
		record(followed());
		if (isCalledByName) settle();
	});
}

void MpmVtkRecorder::stepBegins(const Analysis& engine)
{
	if (&engine != &followed()) return;
	lastStepIter = -1;
	knownTime    = engine.loadTime;
	if (isDue(momentOf(engine))) record(engine); // the initial state
}

void MpmVtkRecorder::stepEnds(const Analysis& engine, bool converged)
{
	if (!converged) return stepFailed(engine);
	if (&engine != &followed()) return;
	lastStepIter = scene->iter;
	knownTime    = engine.loadTime;
	isUnwritten  = true;
	if (lastIsMissing() && endsWithThisIteration(*scene)) record(engine);
}

void MpmVtkRecorder::stepFailed(const Analysis& engine)
{
	const bool hasAdvanced = engine.loadTime > knownTime; // advanced by a part of the step
	if (hasAdvanced) lastStepIter = scene->iter;
	isUnwritten |= hasAdvanced;
	finish();
	lastStepIter = -1;
}

void MpmVtkRecorder::finish()
{
	settleQuietly();
	if (dead || !lastIsMissing()) return;
	isUnwritten = false; // one attempt
	try {
		if (isFirstProcess() || isDivided(followed())) writeAll(followed());
		settle();
	} catch (const std::exception& error) { // must not take the place of what has ended the simulation
		log(Severity::error, getClassName(), string("the last state is missing: ") + error.what());
	}
}

// Waits for the files that are being written; throws what writing them has. `written` has those that are complete.
void MpmVtkRecorder::settle()
{
	if (!inFlight.valid()) return;
	const WrittenFiles outcome = inFlight.get();
	written                    = outcome.files;
	if (outcome.failure) std::rethrow_exception(outcome.failure);
}

void MpmVtkRecorder::settleQuietly()
{
	try {
		settle();
	} catch (const std::exception& error) { // must not take the place of what has ended the simulation
		log(Severity::error, getClassName(), string("a state is missing: ") + error.what());
	}
}

const Analysis& MpmVtkRecorder::followed() const
{
	vector<const Analysis*> candidates;
	for (const auto& engine : scene->engines)
		if (const auto* found = dynamic_cast<const Analysis*>(engine.get()))
			if (solver.empty() || engine->label == solver) candidates.push_back(found);
	if (candidates.size() == 1) return *candidates.front();
	const string wanted = solver.empty() ? "" : " labelled '" + solver + "', as the attribute solver says";
	throw std::invalid_argument(
	        "MpmVtkRecorder follows one MpmImplicitEngine, and O.engines holds " + (candidates.empty() ? "none" : std::to_string(candidates.size()))
	        + wanted + (candidates.empty() ? ". Put it into O.engines, too." : ". Label them, and give the label of one as solver."));
}

// The state in the bodies: a step counts as soon as it is made, though O.iter follows at the end of the iteration.
MpmVtkRecorder::Moment MpmVtkRecorder::momentOf(const Analysis& engine) const
{
	return { scene->iter + (scene->iter == lastStepIter ? 1 : 0), engine.loadTime };
}

// Rule of PeriodicEngine, but for the state to be written instead of the time when the iteration began.
bool MpmVtkRecorder::isDue(const Moment& now)
{
	if (now.iter < iterLast) nDone = 0; // O.resetTime()
	if (nDone == 0) {
		if (firstIterRun > 0) return now.iter >= firstIterRun;
		if (!initRun) restartPeriods(now);
		return initRun;
	}
	if (nDo >= 0 && nDone >= nDo) return false;
	const Real passed = now.time - virtLast, roundOff = 1e-9 * virtPeriod;
	return (iterPeriod > 0 && now.iter - iterLast >= iterPeriod) || (virtPeriod > 0 && passed >= virtPeriod - roundOff)
	        || (realPeriod > 0 && secondsNow() - realLast >= realPeriod);
}

void MpmVtkRecorder::restartPeriods(const Moment& now)
{
	iterLast = now.iter;
	virtLast = now.time;
	realLast = secondsNow();
	++nDone;
}

bool MpmVtkRecorder::lastIsMissing() const { return isUnwritten && nDone > 0 && (nDo < 0 || nDone < nDo); }

bool MpmVtkRecorder::standsBehind(const Analysis& engine) const
{
	for (const auto& listed : scene->engines) {
		if (listed.get() == this) return false;
		if (dynamic_cast<const Analysis*>(listed.get()) == &engine) return true;
	}
	return false;
}

void MpmVtkRecorder::record(const Analysis& engine)
{
	if (isDivided(engine)) fieldsOfPoints = fieldsOfAll(engine);
	writeTogether(engine, [&] { writeAll(engine); });
	if (isLastOfRun(*scene)) settle();
	const Moment now = momentOf(engine);
	if (isDue(now)) restartPeriods(now);
	isUnwritten                    = false;
	static const bool isRegistered = finishAtExit();
	(void)isRegistered;
}

// Start of the names of all files of each kind, whichever way the path is written.
vector<string> MpmVtkRecorder::seriesWritten() const
{
	vector<string> series;
	for (const string& kind : kinds) {
		if (!contains(recorders, kind) && !contains(recorders, "all")) continue;
		const auto      path = std::filesystem::absolute(fileName + kind + ".");
		std::error_code error; // to be told of when the file is written
		const auto      resolved = std::filesystem::weakly_canonical(path, error);
		series.push_back(error ? path : resolved);
	}
	return series;
}

void MpmVtkRecorder::requireOwnFiles() const
{
	const vector<string> own = seriesWritten();
	for (const auto& engine : scene->engines) {
		const auto* other = dynamic_cast<MpmVtkRecorder*>(engine.get());
		if (!other || other == this || other->dead) continue;
		for (const string& series : other->seriesWritten())
			if (contains(own, series))
				throw std::invalid_argument(
				        "MpmVtkRecorder.fileName = '" + fileName + "': another MpmVtkRecorder among O.engines writes the same files, " + series
				        + "*, so that one would replace the other's. Give each a fileName of its own.");
	}
}

// The data of the files are there at once; while they are written, the next step may be made.
void MpmVtkRecorder::writeAll(const Analysis& engine)
{
	settle();
	requireAdmissible();
	requireOwnFiles();
	engine.requireAttributes();
	engine.grid->requireAdmissible();
	vector<StateFile> files;
	const Moment      now = momentOf(engine);
	for (const string& kind : kinds) {
		if (!contains(recorders, kind) && !contains(recorders, "all")) continue;
		const string series = fileName + kind + ".";
		if (isWritten(series, now)) continue;
		const auto cells = kind == "points" ? pointData(*scene, engine, fieldsOfPoints, fields, sectors) : gridCells(kind, *scene, engine);
		files.push_back({ series, stateFile(kind, series + std::to_string(now.iter), engine), now.time, cells });
	}
	inFlight = std::async(std::launch::async, &writeStates, files, written, VtkFormat { ascii, compress });
	if (isDivided(engine)) return settle(); // all processes fail together
	for (const StateFile& file : files)
		written = withFile(written, file);
}

bool MpmVtkRecorder::isWritten(const string& series, const Moment& now) const
{
	const auto latest = std::find_if(written.rbegin(), written.rend(), [&](const auto& entry) { return isOfSeries(entry, series); });
	return latest != written.rend() && latest->second == now.time;
}

} // namespace yade

BOOST_CLASS_EXPORT_IMPLEMENT(yade::MpmVtkRecorder)
static const yade::PluginClasses<yade::MpmVtkRecorder> registeredMpmVtkRecorder(__FILE__);
