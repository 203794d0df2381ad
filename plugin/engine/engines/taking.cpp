// SPDX-License-Identifier: GPL-2.0-or-later
// The points that an engine works on: those that it finds, divided among processes or not, and those that it splits.
#include "engine/analysis/exchange.hpp"
#include "engine/conditions/water/pressure_table.hpp"
#include "engine/engines/MpmImplicitEngine.hpp"
#include "engine/messages/requirements.hpp"
#include "engine/parallel/pieces.hpp"
#include "engine/parallel/processes.hpp"
#include "engine/parallel/sameness.hpp"
#include "engine/points/newPoints.hpp"
#include "yade_api/value_lock.hpp"
#include <numeric>

namespace yade {

// Functions of the pressure answer before the step begins, and before anything is taken over from the scene, which they may ask and even change: then they are asked about what
// there is now.
template <int Dim> void MpmImplicitEngine::askWater(Agreement& agreement)
{
	constexpr int mostTimes = 100;
	for (int time = 0; time < mostTimes; ++time) {
		gimpm::Grid<Dim>   lattice;
		vector<gimpm::Key> cells;
		{
			const ValueLock lock;
			requireRunnable(*this);
			grid->requireAdmissible();
			lattice = grid->lattice<Dim>();
			updateMaterialPoints(points, *scene, mask);
			gimpm::PointCloud<Dim> middles;
			for (const MaterialPoint& point : points)
				if (const gimpm::Vec<Dim> x = point.state->pos.head<Dim>(); // others are refused in a moment
				    x.allFinite() && ((x - lattice.origin) / lattice.cellSize).cwiseAbs().maxCoeff() < lattice.indexLimit)
					middles.position.push_back(x);
			cells = cellsOf(middles, lattice, nullptr);
		}
		if (distributed && processes()) {
			agreement.meet(*this);
			cells = gimpm::joined(*processes(), cells);
			std::sort(cells.begin(), cells.end());
			cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
		}
		if (!Waters<Dim>::ask(*this, lattice, cells)) return;
	}
	throw std::invalid_argument(
	        getClassName() + ".water: MpmWater.pressure brings other material points into the scene whenever it is asked; it must only answer.");
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
	if (distributed && model.processes) {
		Distribution::requireDivisible(*this, points);
		agreement.meet(*this);
		std::int64_t isKnown = plausibility.knows<Dim>(points);
		model.processes->smallest(&isKnown, 1);
		areKnown       = isKnown;
		model.division = distribution.divide<Dim>(*this, points);
		known          = materialsOfAll(*scene, points, *model.processes);
	}
	to.cloud = gather(points, model, known);
	if (areKnown) plausibility.know(to.cloud); // some have come from another process
	if (model.division && !water.empty()) agreement.meet(*this);
}

Body::id_t MpmImplicitEngine::add(NewPoints& added)
{
	const ValueLock lock;
	const auto      all = distributed ? processes() : nullptr;
	vector<int>     own(added.size());
	std::iota(own.begin(), own.end(), 0);
	if (all) own = grid->dim == 3 ? distribution.ownOf<3>(*this, points, added) : distribution.ownOf<2>(*this, points, added);
	vector<shared_ptr<Body>> bodies;
	const auto               make = [&] {
                for (const int i : own)
                        bodies.push_back(added.body(i));
	};
	if (all) admitTogether(make, *all);
	else
		make();
	const Body::id_t first = scene->bodies->size();
	for (size_t i = 0; i < own.size(); ++i)
		scene->bodies->insertAtId(bodies[i], first + own[i]);
	if (!all) return first;
	provideGaps(*scene, first + added.size());
	Pieces::note(*scene, all.get());
	return first;
}

template <int Dim> void MpmImplicitEngine::doubt(const Job<Dim>& job)
{
	const ValueLock lock;
	if (job.model.division) {
		requireSameWater(*job.model.processes, *this);
		pointsOfRun = size_t(job.model.division->sum(Real(points.size())));
	}
	for (int i = 0; i < Plausibility::mostDoubts; ++i) // the same number in all processes
		warnOfPoints(i < int(job.doubts.size()) ? job.doubts[i] : "");
	warn(plausibility.doubtOfBoundaries(*this, points));
	if (!job.model.division) warn(job.surfaceLoads.doubt(job.cloud, job.model.grid));
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

// Of points that this process has. Where they are divided, the others may have a reason, too, and one of them is heard.
void MpmImplicitEngine::warnOfPoints(const string& text) { warn(isDivided(*this) ? firstSaid(text, *processes()) : text); }

#define MPM_INSTANTIATE(Dim)                                                                                                                                   \
	template void MpmImplicitEngine::takePoints(Setup<Dim>&, Agreement&);                                                                                  \
	template void MpmImplicitEngine::askWater<Dim>(Agreement&);                                                                                            \
	template void MpmImplicitEngine::doubt(const Job<Dim>&);                                                                                               \
	template bool MpmImplicitEngine::splitOutgrown(Job<Dim>&);
MPM_INSTANTIATE(2)
MPM_INSTANTIATE(3)
#undef MPM_INSTANTIATE

} // namespace yade
