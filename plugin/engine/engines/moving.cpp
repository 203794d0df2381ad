// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/engines/moving.hpp"
#include "core/base/sentence.hpp"
#include "core/stepping/explicit_step.hpp"
#include "core/terms/inertia/inertia.hpp"
#include "engine/engines/MpmDynamicEngine.hpp"
#include "engine/engines/explicit_steps.hpp"
#include "engine/engines/plastic_work.hpp"
#include "engine/points/energies.hpp"
#include "engine/points/parallel.hpp"

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
        : engine(e), energy(std::isnan(e.firstEnergy) ? energiesOf(points, e.pointMass()).total() : 0), motion(new gimpm::Motion<Dim>)
{
	motion->scheme    = engine.timeScheme();
	motion->ghostMass = engine.ghostMass();
	// so much below that of the balance that what Newton's method leaves is not touched by it
	motion->exactness = std::max(motion->exactness, 1e-3 * job.model.newton.tolerance);
	if (engine.timeTolerance > 0) motion->tolerance = engine.timeTolerance * engine.grid->cellSize;
	const PointMass mass = engine.pointMass();
	for (size_t p = 0; p < points.size(); ++p) {
		motion->mass.push_back(mass(points[p]));
		motion->velocity.push_back(finiteInDimension<Dim>(points[p], "vel", points[p].state->vel));
		motion->acceleration.push_back(finiteInDimension<Dim>(points[p], "acceleration", points[p].state->acceleration));
	}
	for (const auto& material : job.model.materials)
		motion->isElastic.push_back(material.law->isElastic);
	joinRayleigh(job);
	for (const auto& condition : job.conditions)
		condition->joinMotion(*motion, job.model, job.begin);
	job.model.atMiddle = motion->scheme.atMiddle;
	if (!engine.isExplicit())
		job.model.inertia = [known = motion](const gimpm::StepContext<Dim>& step) { return std::make_unique<gimpm::Inertia<Dim>>(*known, step); };
}

template <int Dim> void Moving<Dim>::joinRayleigh(const Job<Dim>& job)
{
	const auto [alpha, beta] = engine.rayleigh;
	if (alpha == 0 && beta == 0) return;
	*rayleigh             = { alpha, beta };
	const auto  materials = std::make_shared<const std::vector<gimpm::Material>>(job.model.materials);
	const auto* masses    = &motion->mass; // masses that include those of the copies where points are divided
	motion->damping.push_back([known = rayleigh, materials, masses, fBar = job.model.fBar](const gimpm::StepContext<Dim>& step) {
		return std::make_unique<gimpm::RayleighDamping<Dim>>(*known, *materials, fBar, *masses, step);
	});
}

// Energy that has come in, without the part that contact has given itself.
template <int Dim> Real Moving<Dim>::energyComeIn() const
{
	return std::abs(engine.firstEnergy) + std::abs(engine.loadWork) + std::abs(engine.boundaryWork) + std::abs(engine.contactWork - engine.givenByContact);
}

template <int Dim> string Moving<Dim>::warningOfContact() const
{
	constexpr Real most = 0.02;
	if (engine.givenByContact <= most * energyComeIn()) return "";
	return gimpm::sentence(
	        "contact has given ", engine.givenByContact, " J that no body has worked, beside ", energyComeIn(),
	        " J that have come in otherwise: steps are too long for soil that passes edges or curved sides of bodies. A smaller O.dt makes it less.");
}

template <int Dim> StepTime Moving<Dim>::begin(Job<Dim>& job, Real from, Real to) const
{
	// Checked by all processes, which are here together.
	if (engine.isExplicit()) requireStable<Dim>(engine, job, to - from);
	if (std::isnan(engine.firstEnergy)) engine.firstEnergy = ofAll(energy, job);
	motion->duration = to - from;
	return { from, to, motion->scheme.atMiddle ? from + motion->duration / 2 : to, gimpm::StepKind::dynamic, energyComeIn() };
}

template <int Dim> void Moving<Dim>::weigh(gimpm::Load<Dim>& load) const
{
	load.motion = motion->duration;
	if (!motion->scheme.atMiddle) return;
	const auto toMiddle = [](gimpm::LoadFactor& factor) { factor.value -= factor.growth / 2; };
	toMiddle(load.factor);
	if (load.ofGravity) toMiddle(*load.ofGravity);
}

template <int Dim> gimpm::StepReport Moving<Dim>::step(Job<Dim>& job, const Attempt<Dim>& tried) const
{
	return gimpm::explicitStep(job.cloud, job.model, tried.load, *motion);
}

template <int Dim> void Moving<Dim>::addWork(const Job<Dim>& job, const StepOutcome<Dim>& step)
{
	const auto&    points = step.points;
	const Real     from = step.from, time = step.time;
	const auto     factor = engine.curveOfLoads().between(from, time), ofGravity = engine.curveOfGravity().between(from, time);
	const Vector3r g = (ofGravity.value + ofGravity.before()) / 2 * engine.gravity;
	// The first process adds the work so far.
	Real work = job.model.division->processes->rank() == 0 ? engine.loadWork : 0;
	for (size_t p = 0; p < points.size(); ++p) {
		Vector3r moved    = Vector3r::Zero();
		moved.head<Dim>() = job.cloud.position[p] - points[p].state->pos.template head<Dim>();
		work += moved.dot(massOfFull(points[p]) * g + (factor.value + factor.before()) / 2 * points[p].state->force);
	}
	engine.loadWork = ofAll(work, job);
	Work sum;
	for (const auto& condition : job.conditions)
		sum += condition->work(step);
	engine.loadWork += sum.ofLoads;
	engine.boundaryWork += sum.ofBoundaries;
	engine.dampingWork += rayleigh->work;
	engine.contactWork += sum.ofContacts;
	engine.givenByContact += sum.given;
	engine.frictionWork += sum.ofFriction;
	engine.penaltyWork += sum.ofPenalties;
	engine.impactWork += motion->impactWork;
	engine.ghostWork += motion->ghostWork;
	engine.gridWork += motion->gridWork;
	engine.loosePoints = motion->loosePoints;
	engine.plasticWork += ofAll(plasticWork(job.cloud, job.model.materials, points), job);
	engine.reactionsBefore = engine.reactions;
}

template <int Dim> void Moving<Dim>::reach(const Job<Dim>& job, const StepOutcome<Dim>& step)
{
	const auto& points = step.points;
	addWork(job, step);
	const PointWriter writer { PointWriter::OfResults() };
	inRanges(points.size(), [&](size_t begin, size_t end) {
		for (size_t p = begin; p < end; ++p) {
			writer.state(points[p]).vel.template head<Dim>()          = motion->velocity[p];
			writer.state(points[p]).acceleration.template head<Dim>() = motion->acceleration[p];
		}
	});
}

template class Moving<2>;
template class Moving<3>;

} // namespace yade
