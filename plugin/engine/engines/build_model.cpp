// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/engines/build_model.hpp"
#include "engine/analysis/empty_model.hpp"
#include "engine/analysis/exchange.hpp"
#include "engine/messages/requirements.hpp"

namespace yade {

template <int Dim>
Setup<Dim> buildModel(
        const Analysis& analysis, const Scene& scene, const vector<MaterialPoint>& points, Real begin, Real target, const TakePoints<Dim>& takePoints)
{
	requireSettings(analysis);
	Setup<Dim> setup;
	setup.conditions = conditionsOf<Dim>(analysis);
	setup.model      = emptyModel<Dim>(analysis, setup.conditions);
	takePoints(setup);
	for (const auto& condition : setup.conditions)
		condition->join(setup.model, { analysis, scene, points, setup.cloud, begin, target });
	return setup;
}

template <int Dim> gimpm::Load<Dim> advance(Setup<Dim>& setup, const Analysis& analysis, const StepTime& step)
{
	auto load = analysis.loadBetween<Dim>(step.from, step.to);
	for (const auto& condition : setup.conditions)
		condition->part(setup.cloud, setup.model);
	for (const auto& condition : setup.conditions)
		condition->advance(step, setup.model, load);
	return load;
}

template <int Dim> CurrentState<Dim> currentState(const Analysis& analysis, const std::shared_ptr<gimpm::Division>& division)
{
	const auto        scene  = analysis.ownScene();
	const auto        points = materialPoints(*scene, analysis.mask);
	const Real        now    = analysis.loadTime;
	CurrentState<Dim> state;
	static_cast<Setup<Dim>&>(state) = buildModel<Dim>(analysis, *scene, points, now, now, [&](Setup<Dim>& to) {
		to.model.division = division;
		to.cloud          = gather(points, to.model);
	});
	state.load                      = advance(state, analysis, { now, now, now });
	return state;
}

#define MPM_INSTANTIATE(Dim)                                                                                                                                   \
	template Setup<Dim>        buildModel(const Analysis&, const Scene&, const vector<MaterialPoint>&, Real, Real, const TakePoints<Dim>&);                \
	template gimpm::Load<Dim>  advance(Setup<Dim>&, const Analysis&, const StepTime&);                                                                     \
	template CurrentState<Dim> currentState(const Analysis&, const std::shared_ptr<gimpm::Division>&);
MPM_INSTANTIATE(2)
MPM_INSTANTIATE(3)
#undef MPM_INSTANTIATE

} // namespace yade
