// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/output/statePieces.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/output/gridCells.hpp"
#include "engine/output/vtkDataSets.hpp"
#include "engine/parallel/distribution.hpp"
#include "engine/parallel/processes.hpp"
#include "yade_api/value_lock.hpp"
#include <algorithm>
#include <filesystem>
#include <vtkUnstructuredGrid.h>

namespace yade {

vector<const PointColumn*> fieldsOfAll(const Analysis& engine)
{
	const auto                 all = holdersOf(engine);
	vector<const PointColumn*> own;
	together(
	        [&] {
		        const ValueLock lock;
		        own = fieldsOf(materialPoints(engine.sceneOfRun(), engine.mask));
	        },
	        *all);
	vector<int64_t> isMissing;
	for (const PointColumn& column : pointColumns())
		isMissing.push_back(std::find(own.begin(), own.end(), &column) == own.end());
	all->smallest(isMissing.data(), int(isMissing.size()));
	own.clear();
	for (size_t c = 0; c < isMissing.size(); ++c)
		if (!isMissing[c]) own.push_back(&pointColumns()[c]);
	return own;
}

void writeTogether(const Analysis& engine, const std::function<void()>& write)
{
	if (isDivided(engine)) together(write, *processes());
	else if (isFirstProcess())
		write();
}

string stateFile(const string& kind, const string& path, const Analysis& engine)
{
	if (!isDivided(engine) || isOfConditions(kind)) return path + ".vtu";
	if (kind == "points") return path + ".pvtu";
	throw std::invalid_argument(
	        "MpmVtkRecorder.recorders = '" + kind
	        + "' does not go with MpmImplicitEngine.distributed yet, by which no process has all points: there are 'points', 'loads', 'walls' and 'contacts'.");
}

bool isOfSeries(const std::pair<string, Real>& file, const string& series) { return file.first.compare(0, series.size(), series) == 0; }

Series withFile(const Series& files, const StateFile& file)
{
	Series     all        = files;
	const auto isReplaced = [&](const auto& entry) { return isOfSeries(entry, file.series) && (entry.first == file.path || entry.second >= file.time); };
	all.erase(std::remove_if(all.begin(), all.end(), isReplaced), all.end());
	all.emplace_back(file.path, file.time);
	return all;
}

namespace {
	void writeState(const StateFile& file, VtkFormat format)
	{
		if (std::filesystem::path(file.path).extension() == ".vtu") {
			if (isFirstProcess()) writeVtu(*file.cells, file.time, file.path, format);
			return;
		}
		const auto all = processes();
		writeVtu(*file.cells, file.time, pieceOf(file.path, all->rank()), format);
		if (all->rank() == 0) writePvtu(*file.cells, file.time, file.path, all->size());
	}
}

WrittenFiles writeStates(const vector<StateFile>& states, const Series& before, VtkFormat format)
{
	WrittenFiles made { before, nullptr };
	try {
		for (const StateFile& file : states) {
			writeState(file, format);
			const Series all = withFile(made.files, file);
			Series       own;
			std::copy_if(all.begin(), all.end(), std::back_inserter(own), [&](const auto& entry) { return isOfSeries(entry, file.series); });
			if (isFirstProcess()) writePvd(own, file.series + "pvd");
			made.files = all;
		}
	} catch (...) {
		made.failure = std::current_exception();
	}
	return made;
}

} // namespace yade
