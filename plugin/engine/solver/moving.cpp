// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/solver/moving.hpp"
#include "core/base/sentence.hpp"
#include "core/stepping/explicit_step.hpp"
#include "core/terms/inertia.hpp"
#include "engine/points/parallel.hpp"
#include "engine/solver/MpmDynamicEngine.hpp"
#include "engine/solver/energies.hpp"
#include "engine/solver/explicit_steps.hpp"
#include "engine/solver/plastic_work.hpp"

namespace yade {

namespace {
	template <int Dim> gimpm::Vec<Dim> finiteInDimension(const MaterialPoint& point, const char* name, const Vector3r& value)
	{
		const bool isOutOfPlane = Dim == 2 && value[2] != 0;
		if (value.allFinite() && !isOutOfPlane) return value.head<Dim>();
		std::ostringstream text;
		text << "Body #" << point.id << ": MpmState." << name << " = (" << value.transpose() << ") is not admitted: expected three finite numbers"
		     << (Dim == 2 ? ", without a component along z on a grid with dim=2." : ".");
		throw std::invalid_argument(text.str());
	}

	// From that of the points of this process.
	template <int Dim> Real ofAll(Real own, const Job<Dim>& job) { return job.model.division->sum(own); }
}

template <int Dim>
Moving<Dim>::Moving(MpmDynamicEngine& e, Job<Dim>& job, const vector<MaterialPoint>& points)
        : engine(e), energy(std::isnan(e.firstEnergy) ? energiesOf(points).total() : 0), motion(new gimpm::Motion<Dim>)
{
	motion->scheme    = engine.timeScheme();
	motion->ghostMass = engine.ghostMass();
	// so much below that of the balance that what Newton's method leaves is not touched by it
	motion->exactness = std::max(motion->exactness, 1e-3 * job.model.newton.tolerance);
	if (engine.timeTolerance > 0) motion->tolerance = engine.timeTolerance * engine.grid->cellSize;
	for (size_t p = 0; p < points.size(); ++p) {
		motion->mass.push_back(job.model.materials[job.cloud.material[p]].density * job.cloud.volume0[p]);
		motion->velocity.push_back(finiteInDimension<Dim>(points[p], "vel", points[p].state->vel));
		motion->acceleration.push_back(finiteInDimension<Dim>(points[p], "acceleration", points[p].state->acceleration));
	}
	motion->contacts   = job.contacts.weigh(motion->scheme.weightOfContact());
	shaking            = std::make_unique<Shaking<Dim>>(engine, job, *motion);
	job.model.atMiddle = motion->scheme.atMiddle;
	if (!engine.isExplicit())
		job.model.terms.push_back([known = motion](const gimpm::Beginning<Dim>& step) { return std::make_unique<gimpm::Inertia<Dim>>(*known, step); });
	job.surfaceLoads.beginAt(job.begin);
	job.waters.wantWork();
}

// What contact has given itself is no part of it.
template <int Dim> Real Moving<Dim>::energyComeIn() const
{
	return std::abs(engine.firstEnergy) + std::abs(engine.loadWork) + std::abs(engine.boundaryWork) + std::abs(engine.contactWork - engine.givenByContact);
}

template <int Dim> string Moving<Dim>::doubtOfContact() const
{
	constexpr Real most = 0.02;
	if (engine.givenByContact <= most * energyComeIn()) return "";
	return gimpm::sentence(
	        "contact has given ", engine.givenByContact, " J that no body has worked, beside ", energyComeIn(),
	        " J that have come in otherwise: steps are too long for soil that passes edges or curved sides of bodies. A smaller O.dt makes it less.");
}

template <int Dim> void Moving<Dim>::begin(Job<Dim>& job, Attempt<Dim>& next, Real from) const
{
	if (engine.isExplicit()) requireStable<Dim>(engine, job, next.time - from); // by all processes, which are here together
	if (std::isnan(engine.firstEnergy)) engine.firstEnergy = ofAll(energy, job);
	motion->duration = next.time - from;
	next.load.motion = motion->duration;
	job.contacts.know(energyComeIn());
	shaking->begin(next, from, *motion);
	if (!motion->scheme.atMiddle) return;
	const auto toMiddle = [](gimpm::LoadFactor& factor) { factor.value -= factor.growth / 2; };
	toMiddle(next.load.factor);
	if (next.load.ofGravity) toMiddle(*next.load.ofGravity);
	job.surfaceLoads.advanceTo(from + motion->duration / 2);
	job.waters.advance(from, from + motion->duration / 2);
}

template <int Dim> gimpm::StepReport Moving<Dim>::step(Job<Dim>& job, const Attempt<Dim>& tried) const
{
	return gimpm::explicitStep(job.cloud, job.model, tried.load, *motion);
}

// Reactions are those of the two ends, where they are known; with the midpoint rule those of the middle.
template <int Dim> Real Moving<Dim>::workOfBoundaries(Real from, Real time) const
{
	const auto &now = engine.reactions, &before = engine.reactionsBefore;
	const bool  hasBefore = before.size() == now.size() && !motion->scheme.atMiddle;
	Real        work      = 0;
	for (size_t b = 0; b < now.size(); ++b) {
		const MpmBoundary& boundary = *engine.boundaries[b];
		if (boundary.motion) {
			work += boundary.motion->displacementBetween(from, time).dot(hasBefore ? Vector3r((now[b] + before[b]) / 2) : now[b]);
			continue;
		}
		const Real     growth = engine.curveOf(boundary).between(from, time).growth;
		const Vector3r moved  = boundary.surface ? Vector3r((time - from) * boundary.velocity) : Vector3r(growth * boundary.displacement);
		work += moved.dot(hasBefore ? Vector3r((now[b] + before[b]) / 2) : now[b]);
	}
	return work;
}

template <int Dim> void Moving<Dim>::addWork(const Job<Dim>& job, Real time, const vector<MaterialPoint>& points)
{
	const Real     from   = engine.loadTime;
	const auto     factor = engine.curveOfLoads().between(from, time), ofGravity = engine.curveOfGravity().between(from, time);
	const Vector3r g    = (ofGravity.value + ofGravity.before()) / 2 * engine.gravity;
	Real           work = job.model.division->processes->rank() == 0 ? engine.loadWork : 0; // who brings along what there is already
	for (size_t p = 0; p < points.size(); ++p) {
		Vector3r moved    = Vector3r::Zero();
		moved.head<Dim>() = job.cloud.position[p] - points[p].state->pos.template head<Dim>();
		work += moved.dot(motion->mass[p] * g + (factor.value + factor.before()) / 2 * points[p].state->force);
	}
	engine.loadWork = ofAll(work, job);
	engine.loadWork += job.surfaceLoads.work() + job.waters.work();
	engine.boundaryWork += workOfBoundaries(from, time) + shaking->workOfEdges();
	engine.dampingWork += shaking->dampingWork();
	engine.contactWork += job.contacts.work();
	engine.givenByContact += std::max(0., job.contacts.gift());
	engine.impactWork += motion->impactWork;
	engine.ghostWork += motion->ghostWork;
	engine.gridWork += motion->gridWork;
	engine.plasticWork += ofAll(plasticWork(job.cloud, job.model.materials, points), job);
	engine.reactionsBefore = engine.reactions;
}

template <int Dim> void Moving<Dim>::reach(const Job<Dim>& job, Real time, const vector<MaterialPoint>& points)
{
	addWork(job, time, points);
	shaking->scatter(engine.last);
	inRanges(points.size(), [&](size_t begin, size_t end) {
		for (size_t p = begin; p < end; ++p) {
			points[p].state->vel.template head<Dim>()          = motion->velocity[p];
			points[p].state->acceleration.template head<Dim>() = motion->acceleration[p];
		}
	});
}

template class Moving<2>;
template class Moving<3>;

} // namespace yade
