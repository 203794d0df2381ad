// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/output/statePieces.hpp"
#include "engine/analysis/analysis.hpp"
#include "engine/output/gridCells.hpp"
#include "engine/output/vtkDataSets.hpp"
#include "engine/parallel/distribution.hpp"
#include "engine/parallel/processes.hpp"
#include "yade_api/value_lock.hpp"
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

void writeState(vtkUnstructuredGrid& cells, Real time, const string& file, VtkFormat format)
{
	if (std::filesystem::path(file).extension() == ".vtu") {
		if (isFirstProcess()) writeVtu(cells, time, file, format);
		return;
	}
	const auto all = processes();
	writeVtu(cells, time, pieceOf(file, all->rank()), format);
	if (all->rank() == 0) writePvtu(cells, time, file, all->size());
}

} // namespace yade
