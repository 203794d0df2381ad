// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Files of a state, of which several processes may have a piece each.
#include "engine/output/vtkDataSets.hpp"
#include "engine/output/vtkFiles.hpp"
#include "engine/points/columns.hpp"
#include <exception>
#include <functional>

namespace yade {
class Analysis;

using Columns = vector<const PointColumn*>;

// Columns that are fields of the points of an engine that are divided, whatever process they are in. All processes
// call it.
vector<const PointColumn*> fieldsOfAll(const Analysis&);

// Calls write() in the first process, or where points are divided in all of them, which throw if one does.
void writeTogether(const Analysis&, const std::function<void()>& write);

// The path with its ending of what the .pvd lists, and the files: the .vtu of what every process has as a whole, or the
// .pvtu and the piece of this process. std::invalid_argument for a kind of which no process has the whole.
string stateFile(const string& kind, const string& path, const Analysis&);

// One state of a series, the files of which have names that begin alike.
struct StateFile {
	string   series, path;
	Real     time;
	VtkCells cells;
};

bool isOfSeries(const std::pair<string, Real>& file, const string& series);

// The files with this one, which replaces those of the series that are not earlier: a step has been repeated, or time
// set back.
Series withFile(const Series&, const StateFile&);

// Files that are complete, with the time of each, and what has kept the next one from it.
struct WrittenFiles {
	Series             files;
	std::exception_ptr failure;
};

// Writes states, and with each the .pvd of its series.
WrittenFiles writeStates(const vector<StateFile>&, const Series& before, VtkFormat);

} // namespace yade
