// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/output/statePieces.hpp"
#include "engine/output/vtkDataSets.hpp"
#include "engine/solver/MpmImplicitEngine.hpp"
#include "engine/solver/processes.hpp"
#include "yade_api/value_lock.hpp"
#include <filesystem>
#include <vtkUnstructuredGrid.h>

namespace yade {

vector<const PointColumn*> fieldsOfAll(const MpmImplicitEngine& engine)
{
	const auto                 all = holdersOf(engine);
	vector<const PointColumn*> own;
	together(
	        [&] {
		        const ValueLock lock;
		        own = fieldsOf(materialPoints(*engine.scene, engine.mask));
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

void writeTogether(const MpmImplicitEngine& engine, const std::function<void()>& write)
{
	if (isDivided(engine)) together(write, *processes());
	else if (isFirstProcess())
		write();
}

string stateFile(const string& kind, const string& path, const MpmImplicitEngine& engine)
{
	const bool isWhole = kind == "loads" || kind == "walls" || kind == "contacts"; // in every process
	if (!isDivided(engine) || isWhole) return path + ".vtu";
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
