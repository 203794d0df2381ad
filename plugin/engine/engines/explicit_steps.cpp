// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/engines/explicit_steps.hpp"
#include "core/base/sentence.hpp"
#include "core/stepping/critical_step.hpp"
#include "engine/engines/MpmDynamicEngine.hpp"
#include "engine/engines/build_model.hpp"
#include "engine/parallel/distribution.hpp"
#include "engine/parallel/processes.hpp"
#include "yade_api/value_lock.hpp"

namespace yade {

namespace {
	template <class... Parts> [[noreturn]] void refuseExplicit(const Parts&... parts)
	{
		throw std::invalid_argument(gimpm::sentence("MpmDynamicEngine, scheme='explicit': ", parts...));
	}

	template <int Dim> Penalty stiffestOf(const Setup<Dim>& setup)
	{
		Penalty stiffest;
		for (const auto& condition : setup.conditions)
			if (const Penalty own = condition->penalty(); own.size > stiffest.size) stiffest = own;
		return stiffest;
	}

	template <int Dim> Real limit(const MpmDynamicEngine& engine, const Setup<Dim>& of)
	{
		return gimpm::criticalStep(of.cloud, of.model, engine.ghostMass(), stiffestOf(of).size);
	}

	// Value for the present state of the scene.
	template <int Dim, class F> Real ofNow(MpmDynamicEngine& engine, F&& of)
	{
		const ValueLock lock;
		return of(currentState<Dim>(engine, std::make_shared<gimpm::Division>(gimpm::Division { holdersOf(engine) })));
	}
	template <class F> Real ofNow(MpmDynamicEngine& engine, F&& of)
	{
		if (!engine.grid || (!isDivided(engine) && materialPoints(*engine.ownScene(), engine.mask).empty()))
			return std::numeric_limits<Real>::quiet_NaN();
		return engine.grid->dim == 3 ? ofNow<3>(engine, of) : ofNow<2>(engine, of);
	}
}

void requireExplicit(const MpmDynamicEngine& engine)
{
	const MpmGhost& ghost = *engine.ghost;
	if (engine.timeTolerance > 0)
		refuseExplicit("timeTolerance = ", engine.timeTolerance, " would cut steps, which are not cut here: leave it 0 and give O.dt.");
	if (engine.rayleigh.first != 0 || engine.rayleigh.second != 0)
		refuseExplicit(
		        "rayleigh = (", engine.rayleigh.first, ", ", engine.rayleigh.second,
		        ") needs a stiffness matrix, which explicit steps do without: take an implicit scheme, or (0, 0).");
	if (ghost.factor > 0 && ghost.massFactor == 0)
		refuseExplicit(
		        "ghost.massFactor = 0 with ghost.factor = ", ghost.factor,
		        ": ghost stiffness without ghost mass would be too stiff for nodes of nearly empty cells. Without ghost mass take ghost=MpmGhost(factor=0), which lumps the "
		        "mass; with it a massFactor > 0 (1/4).");
}

template <int Dim> void requireStable(const MpmDynamicEngine& engine, const Setup<Dim>& setup, Real duration)
{
	const Real critical = limit(engine, setup);
	// a step that was admitted is not refused for the small strains that it leads to.
	constexpr Real margin = 0.02;
	if (duration <= critical * (1 + margin)) return;
	const string remedy = stiffestOf(setup).remedy;
	refuseExplicit(
	        "a step of ", duration, " s (O.dt", engine.iterPeriod > 1 ? " times iterPeriod" : "", ") is above the critical one, ", critical,
	        " s, and would be unstable. Give a smaller O.dt, as 0.9 * solver.criticalTimeStep()", remedy.empty() ? "" : ", ", remedy,
	        ", larger cells, or an implicit scheme, which has no limit.");
}

Real criticalTimeStep(MpmDynamicEngine& engine)
{
	return ofNow(engine, [&](const auto& now) { return limit(engine, now); });
}

Real waveSpeed(MpmDynamicEngine& engine)
{
	return ofNow(engine, [](const auto& now) { return std::sqrt(gimpm::stiffest(now.cloud, now.model).pressureWave); });
}

template void requireStable(const MpmDynamicEngine&, const Setup<2>&, Real);
template void requireStable(const MpmDynamicEngine&, const Setup<3>&, Real);

} // namespace yade
