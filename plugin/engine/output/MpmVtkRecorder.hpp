// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "engine/analysis/LoadStepObserver.hpp"
#include "engine/output/statePieces.hpp"
#include "yade_api/exposed.hpp"
#include <future>

namespace yade {

class MpmVtkRecorder : public Exposed<MpmVtkRecorder, PeriodicEngine>, public LoadStepObserver {
public:
	string         fileName; // must be given
	vector<string> recorders { "points" };
	vector<string> fields { "all" };
	bool           ascii    = false;
	bool           compress = true;
	string         solver;
	int            sectors = 0;
	Series         written;

	MpmVtkRecorder();
	~MpmVtkRecorder() override;

	YADE_API_NAME(MpmVtkRecorder)
	static const char* doc()
	{
		return "Writes the states of an implicit material point analysis for ParaView: files <fileName><kind>.<O.iter at the end of the iteration>.vtu, "
		       "and <fileName><kind>.pvd, to be opened there, which lists them with their times.\n\n"
		       "Completed steps count. The initial state is written too (unless *initRun* is False), and so is the last one of a run. After O.pause() or "
		       "O.step(), and before O.reset() or O.load(), call recorder() to have the state written that has been reached.\n\n"
		       "Set first: *fileName* = 'out/slope-' and *iterPeriod* = 10. YADE's own VTKRecorder ends YADE by a segmentation fault with "
		       "recorders=['all']: use this one. Page: plugin/docs/classes/MpmVtkRecorder.md.";
	}
	template <class V> static void attributes(V&& v)
	{
		v("fileName", &MpmVtkRecorder::fileName, 0, "Start of all file names, as in 'out/slope-'; without default. Missing folders are created.",
		  admitting(
		          "the start of the files' names, as in 'out/slope-', without line breaks and other control characters; there is no default",
		          isFileName));
		v("recorders", &MpmVtkRecorder::recorders, 0,
		  "Kinds of files: 'points', domains with *fields*; 'grid', cells with material; 'ghostFaces', stabilised faces; 'loads', loaded surfaces; "
		  "'walls', surfaces of boundaries; 'contacts', faces of bodies; 'all'. "
		  "Read as a tuple.",
		  admitting("one or more of 'points', 'grid', 'ghostFaces', 'loads', 'walls', 'contacts' and 'all'", areKinds));
		v("fields", &MpmVtkRecorder::fields, 0,
		  "Fields of 'points' that are written, by name, or 'all', the default; an empty sequence leaves the domains alone. Few fields make small "
		  "files. Read as a tuple.",
		  admitting(whichFields(), areFields));
		v("ascii", &MpmVtkRecorder::ascii, 0, "Write numbers as text, in larger files.");
		v("compress", &MpmVtkRecorder::compress, 0, "Compress the data with LZ4, unless *ascii*; for readers without LZ4 (meshio) False.");
		v("solver", &MpmVtkRecorder::solver, 0, "Label of the MpmImplicitEngine to follow; needed only if there are several.");
		v("sectors", &MpmVtkRecorder::sectors, 0,
		  "Parts of the circle into which 'points' are revolved about the axis, with MpmGrid.axisymmetric, at least 3; 0, the default: the section.",
		  admitting("0 or a number of parts >= 3", [](int n) { return n == 0 || n >= 3; }));
		v("written", &MpmVtkRecorder::written, readonly, "Files that the .pvd files list, each with the time [s] of its state.");
	}

	bool isActivated() override;
	void action() override;
	void stepBegins(const Analysis&) override;
	void stepEnds(const Analysis&, bool converged) override;

	// Writes the last state of this process if no file has it.
	void finish();

	static bool isFileName(const string&);
	static bool areKinds(const vector<string>&);
	static bool areFields(const vector<string>&);

	static const char* whichFields();

private:
	struct Moment {
		long iter; // completed iterations
		Real time;
	};

	const Analysis& followed() const;
	void            requireOwnFiles() const;
	vector<string>  seriesWritten() const;
	Moment          momentOf(const Analysis&) const;
	bool            isDue(const Moment&);
	void            restartPeriods(const Moment&);
	bool            lastIsMissing() const;
	bool            standsBehind(const Analysis&) const;
	void            stepFailed(const Analysis&);
	void            record(const Analysis&);
	void            writeAll(const Analysis&);
	bool            isWritten(const string& series, const Moment&) const;
	void            settle();
	void            settleQuietly();

	// Members of this process, so they are not saved:
	long                       lastStepIter = -1;                                     // O.iter in the last step
	Real                       knownTime    = std::numeric_limits<Real>::quiet_NaN(); // time of the state that was met last
	vector<const PointColumn*> fieldsOfPoints;                                        // fields that there are, written last
	bool                       isUnwritten = false;                                   // true if no file has that state, which this process has reached
	bool                       isInRun     = false;                                   // true if YADE's loop asks for the next file
	std::future<WrittenFiles>  inFlight;                                              // while they are written
};

} // namespace yade

BOOST_CLASS_EXPORT_KEY(yade::MpmVtkRecorder)
