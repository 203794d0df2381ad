// SPDX-License-Identifier: GPL-2.0-or-later
// The points that an engine works on: those that it finds, divided among processes or not, and those that it splits.
#include "engine/points/newPoints.hpp"
#include "engine/solver/MpmImplicitEngine.hpp"
#include "engine/solver/exchange.hpp"
#include "engine/solver/pieces.hpp"
#include "engine/solver/pressure_table.hpp"
#include "engine/solver/processes.hpp"
#include "engine/solver/requirements.hpp"
#include "engine/solver/sameness.hpp"
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
			cells = cellsOf(middles, lattice);
		}
		if (distributed) {
			agreement.meet(*this);
			cells = gimpm::united(*processes(), std::move(cells));
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
	if (distributed && model.processes->size() > 1) {
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
	if (!model.division->isWhole() && !water.empty()) agreement.meet(*this);
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

template <int Dim> void MpmImplicitEngine::doubt(const Job<Dim>& job)
{
	const ValueLock lock;
	requireSameWater(*job.model.division->processes, *this);
	pointsOfRun = size_t(job.model.division->sum(Real(points.size())));
	for (int i = 0; i < Plausibility::mostDoubts; ++i) // the same number in all processes
		warnOfPoints(i < int(job.doubts.size()) ? job.doubts[i] : "");
	warn(plausibility.doubtOfBoundaries(*this, points));
	if (job.model.division->isWhole()) warn(job.surfaceLoads.doubt(job.cloud, job.model.grid));
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
void MpmImplicitEngine::warnOfPoints(const string& text) { warn(gimpm::firstSaid(*holdersOf(*this), text)); }

#define MPM_INSTANTIATE(Dim)                                                                                                                                   \
	template void MpmImplicitEngine::takePoints(Setup<Dim>&, Agreement&);                                                                                  \
	template void MpmImplicitEngine::askWater<Dim>(Agreement&);                                                                                            \
	template void MpmImplicitEngine::doubt(const Job<Dim>&);                                                                                               \
	template bool MpmImplicitEngine::splitOutgrown(Job<Dim>&);
MPM_INSTANTIATE(2)
MPM_INSTANTIATE(3)
#undef MPM_INSTANTIATE

} // namespace yade
